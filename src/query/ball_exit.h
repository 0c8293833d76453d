#pragma once

#include <algorithm>
#include <cmath>

#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd {

/// Where a segment leaves a ball that it is in at t; t if it is not.
class BallExit {
 public:
  explicit BallExit(const Segment& segment)
      : start_(segment.start),
        step_(segment.end - segment.start),
        length2_(step_.squaredNorm()),
        per_length2_(1.0 / length2_) {}

  double operator()(const Vector3d& center, double radius, double t) const {
    if (!(radius > 0.0) || !(length2_ > 0.0)) return t;
    const Vector3d from = start_ - center;
    const double half_b = from.dot(step_), c = from.squaredNorm() - radius * radius;
    const double discriminant = half_b * half_b - length2_ * c;
    if (!(discriminant > 0.0)) return t;
    const double root = std::sqrt(discriminant), enter = (-half_b - root) * per_length2_;
    return enter <= t ? std::max(t, (root - half_b) * per_length2_) : t;
  }

 private:
  Vector3d start_, step_;
  double length2_, per_length2_;
};

}  // namespace sdf_ccd
