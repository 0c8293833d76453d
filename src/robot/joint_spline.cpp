#include "robot/joint_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/number_text.h"

namespace sdf_ccd {

JointSpline::JointSpline(JointSplineOrder order, const JointSplinePoint& start, const JointSplinePoint& end,
                         double duration)
    : duration_(duration) {
  // Time is relative to the duration: velocities are multiplied by the duration, accelerations by its square.
  const double T = duration, p0 = start.position, p1 = end.position;
  const double v0 = T * start.velocity, v1 = T * end.velocity;
  const double a0 = T * T * start.acceleration, a1 = T * T * end.acceleration;
  switch (order) {
    case JointSplineOrder::kLinear:
      coefficients_ = {p0, p1 - p0};
      break;
    case JointSplineOrder::kCubic:
      coefficients_ = {p0, v0, 3.0 * (p1 - p0) - 2.0 * v0 - v1, 2.0 * (p0 - p1) + v0 + v1};
      break;
    case JointSplineOrder::kQuintic:
      coefficients_ = {p0,
                       v0,
                       0.5 * a0,
                       10.0 * (p1 - p0) - 6.0 * v0 - 4.0 * v1 - 1.5 * a0 + 0.5 * a1,
                       15.0 * (p0 - p1) + 8.0 * v0 + 7.0 * v1 + 1.5 * a0 - a1,
                       6.0 * (p1 - p0) - 3.0 * (v0 + v1) - 0.5 * a0 + 0.5 * a1};
      break;
  }
}

double JointSpline::position(double time) const {
  const double x = time / duration_;
  double sum = 0.0;
  for (int k = 5; k >= 0; --k) sum = sum * x + coefficients_[k];
  return sum;
}

double JointSpline::largestAcceleration() const {
  // The second derivative c0 + c1 x + c2 x² + c3 x³ lies in the hull of its Bézier coefficients.
  const double c0 = 2.0 * coefficients_[2], c1 = 6.0 * coefficients_[3], c2 = 12.0 * coefficients_[4],
               c3 = 20.0 * coefficients_[5];
  const std::array<double, 4> bezier = {c0, c0 + c1 / 3.0, c0 + 2.0 * c1 / 3.0 + c2 / 3.0, c0 + c1 + c2 + c3};
  double largest = 0.0;
  for (const double b : bezier) {
    if (!std::isfinite(b)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(b));
  }
  return largest / (duration_ * duration_);
}

int piecesWithin(const JointSpline& spline, double duration, double tolerance) {
  constexpr double kMax = 1e6;
  const double acceleration = spline.largestAcceleration();
  const double pieces = std::max(1.0, std::ceil(duration * std::sqrt(acceleration / (8.0 * tolerance))));
  if (!(pieces <= kMax)) {
    throw std::invalid_argument("a joint accelerates by " + numberText(acceleration) + " per s² for " +
                                numberText(duration) + " s: more than can be checked");
  }
  return static_cast<int>(pieces);
}

}  // namespace sdf_ccd
