#pragma once

#include <cmath>
#include <limits>

#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// The parameter at which a segment leaves a sphere that contains its point at t; t if the sphere does not contain it.
class BallExit {
 public:
  explicit BallExit(const Segment& segment)
      : start_(segment.start),
        step_(segment.end - segment.start),
        length2_(step_.squaredNorm()),
        per_length2_(1.0 / length2_),
        rounding_(4.0 * std::numeric_limits<double>::epsilon() * (start_.norm() + step_.norm())) {}

  double operator()(const Vector3d& center, double radius, double t) const {
    const double free = radius - rounding_;
    if (!(free > 0.0) || !(length2_ > 0.0)) return t;
    // Relative to the point at t: relative to the start of a long segment, rounding would exceed the sphere's size.
    const Vector3d from = start_ + t * step_ - center;
    const double half_b = from.dot(step_), c = from.squaredNorm() - free * free;
    if (!(c < 0.0)) return t;
    return t + (std::sqrt(half_b * half_b - length2_ * c) - half_b) * per_length2_;
  }

 private:
  Vector3d start_, step_;
  double length2_, per_length2_;
  double rounding_;  ///< of points along the segment [m]
};

}  // namespace sdf_ccd
