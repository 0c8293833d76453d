#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "motion/motion_sampling.h"
#include "screw_motion.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// Poses of all bodies at a time [s] from the motion's start; called with times from its first waypoint to its last.
using PosesAt = std::function<void(double time, std::vector<Isometry3d>& X_WB)>;

/// Per body, a bound of the third derivative of the position in the world of any point of its ball, while s runs from 0
/// to 1 from the first time to the second [m]; see ChainDerivatives. Infinite if nothing is known.
using JerkBounds = std::function<void(double start, double end, std::vector<double>& jerk)>;

/// A motion as a function of time. Poses at some times do not bound the motion between them: so a bound comes with it.
struct MotionSource {
  PosesAt poses_at;
  JerkBounds jerk_bounds;
};

/// Samples motions whose twists are not constant between waypoints (tf2 and trajectories rotate joints uniformly), so
/// that the error of assuming constant twists between the samples is within the tolerance: the time between two
/// waypoints is halved as long as the bound exceeds it. Memory is reused from motion to motion.
///
/// The bound of the deviation e(s) from the screw: e(0) = e(1) = 0, and e(½) = m is measured. The difference of e from
/// the parabola through these three is at most max|s (s − ½) (s − 1)| / 6 = √3/216 of the third derivative's
/// bound (Lagrange's remainder), so |e| ≤ |m| + √3/216 (jerk of the motion + jerk of the screw). That holds however
/// far bodies rotate.
class MotionSampler {
 public:
  /// @param balls  per body: holds its points, frame B.
  MotionSampler(std::vector<BoundingBall> balls, const MotionSampling& sampling);

  /// Appends samples to those of the motion, which are not read: nothing is known of the motion between the last of
  /// these and the first new one.
  /// @param waypoints  times, increasing [s]; all of them are kept.
  /// @param motion  `missing` is read: bodies it names are skipped. Errors do not decrease.
  /// @throws std::invalid_argument if a pose is not finite, or its rotation not orthonormal.
  void add(const std::vector<double>& waypoints, const MotionSource& source, CycleMotion& motion) {
    add(waypoints, source, all_, motion);
  }

  /// The same for some bodies: of the others nothing is read or written.
  /// @param bodies  their indices.
  void add(const std::vector<double>& waypoints, const MotionSource& source, const std::vector<std::size_t>& bodies,
           CycleMotion& motion);

 private:
  class Run;

  std::vector<BoundingBall> balls_;
  std::vector<std::size_t> all_;  // indices of all bodies
  MotionSampling sampling_;
  std::vector<std::vector<Isometry3d>> X_middle_;  // per number of halvings that are left
  std::vector<Isometry3d> X_end_;
  std::vector<double> jerk_, deviation_;  // per body
};

/// Samples a whole motion. @param waypoints  the first is 0. @param motion  its times, poses and errors are replaced.
void sampleMotion(const std::vector<double>& waypoints, const MotionSource& source,
                  const std::vector<BoundingBall>& balls, const MotionSampling& sampling, CycleMotion& motion);

}  // namespace sdf_ccd
