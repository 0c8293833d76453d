#pragma once

#include <array>
#include <vector>

namespace sdf_ccd {

/// What is given of a joint at one time; velocities and accelerations need not be.
struct JointKnot {
  double position = 0.0;      ///< [rad, m]
  double velocity = 0.0;      ///< [1/s]
  double acceleration = 0.0;  ///< [1/s²]
};

enum class JointSplineOrder { kLinear, kCubic, kQuintic };

/// How a joint moves from one time to the next, as joint_trajectory_controller has it: by the polynomial of least
/// degree that has what is given at both ends.
///
/// Source: ros_controllers, joint_trajectory_controller, quintic_spline_segment.h. It takes cubic splines where only
/// velocities are given, quintic ones where accelerations are too.
class JointSpline {
 public:
  /// @param duration  positive [s].
  JointSpline(JointSplineOrder order, const JointKnot& start, const JointKnot& end, double duration);

  double position(double time) const;

  /// No acceleration between the two times is larger: bounds by the Bézier coefficients of its polynomial [1/s²].
  double largestAcceleration() const;

 private:
  std::array<double, 6> coefficients_{};  // of powers of time over duration
  double duration_;
};

/// Into how many pieces of the same length linear motion has to be cut so that it strays from the spline by no more
/// than the tolerance: |q(t) − linear| ≤ max |q̈| h² / 8 on a piece of length h.
/// @throws std::invalid_argument if these are more than a million.
int piecesWithin(const JointSpline& spline, double duration, double tolerance);

}  // namespace sdf_ccd
