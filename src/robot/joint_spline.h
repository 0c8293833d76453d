#pragma once

#include <array>
#include <vector>

namespace sdf_ccd {

/// Values of a joint at one time; velocities and accelerations are optional.
struct JointSplinePoint {
  double position = 0.0;      ///< [rad, m]
  double velocity = 0.0;      ///< [1/s]
  double acceleration = 0.0;  ///< [1/s²]
};

enum class JointSplineOrder { kLinear, kCubic, kQuintic };

/// The motion of a joint between two times, as in joint_trajectory_controller: the polynomial of lowest degree with the
/// values given at both ends.
///
/// Source: ros_controllers, joint_trajectory_controller, quintic_spline_segment.h. It uses cubic splines if only
/// velocities are given, quintic ones if accelerations are given too.
class JointSpline {
 public:
  /// @param duration  positive [s].
  JointSpline(JointSplineOrder order, const JointSplinePoint& start, const JointSplinePoint& end, double duration);

  double position(double time) const;

  /// Upper bound of the acceleration between the two times, by the Bézier coefficients of its polynomial [1/s²].
  double largestAcceleration() const;

 private:
  std::array<double, 6> coefficients_{};  // of powers of time over duration
  double duration_;
};

/// Number of equal pieces of linear motion that deviate from the spline by no more than the tolerance: |q(t) −
/// linear| ≤ max |q̈| h² / 8 on a piece of length h.
/// @throws std::invalid_argument if it exceeds a million.
int piecesWithin(const JointSpline& spline, double duration, double tolerance);

}  // namespace sdf_ccd
