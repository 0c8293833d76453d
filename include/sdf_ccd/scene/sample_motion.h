#pragma once

#include <functional>
#include <vector>

#include "sdf_ccd/motion/screw_motion.h"
#include "sdf_ccd/scene/monitor.h"

namespace sdf_ccd {

/// Poses of all bodies at a time [s] from the motion's start; called with times from its first knot to its last.
using PosesAt = std::function<void(double time, std::vector<Isometry3d>& X_WB)>;

struct MotionSampling {
  double tolerance = 1e-4;  ///< deviation aimed at [m]
  int max_halvings = 5;     ///< of the time between two knots; what deviation is left then is reported
};

/// Samples a motion that is not of constant twist between its knots (tf2 turns each joint evenly, a trajectory too),
/// so that taking it as such between the samples is wrong by no more than the tolerance: the time between two knots
/// is halved as long as the pose in its middle is farther than that from the screw's.
///
/// No body may turn by more than half a revolution against another between two knots: poses do not tell revolutions,
/// so a whole one between two knots would look like rest.
///
/// The deviation is zero at both ends and largest in the middle, up to terms that vanish with the angle turned.
/// @param knots   increasing, the first 0 [s]; all of them are kept.
/// @param balls   per body: holds its points, frame B.
/// @param motion  `missing` is read: what it names is not looked at. Times, poses and errors are set; memory reused.
void sampleMotion(const std::vector<double>& knots, const PosesAt& poses_at, const std::vector<BoundingBall>& balls,
                  const MotionSampling& sampling, CycleMotion& motion);

/// Holds the body's surface, frame B: its shell's points, else its fields' boxes. Of a half-space, what lies within
/// 10 m of the body's origin.
BoundingBall motionBall(const Body& body);

}  // namespace sdf_ccd
