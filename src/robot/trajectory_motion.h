#pragma once

#include <cstddef>
#include <vector>

#include "motion/sample_motion.h"
#include "robot/planned_motion.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// The motion of bodies that a robot carries along a trajectory, with an error bound between samples: from the joints'
/// rates and reaches along each body's chain (ChainDerivatives), independent of the sampled poses.
///
/// Joints that do not move add nothing, and everything between two moving joints counts as one piece. So a body that
/// only translates has a jerk of 0; for a body that rotates about one joint the bound is exact if the centre of its
/// ball lies on the plane through that joint's origin normal to the axis.
class TrajectoryMotion {
 public:
  /// @param robot  must outlive this.
  /// @throws std::invalid_argument if there are fewer than two waypoints, times do not increase, states do not name the
  /// same joints, or a pose and the next one are kAmbiguousTurn apart; also as forwardKinematics() does.
  TrajectoryMotion(const RobotModel& robot, const RobotTrajectory& trajectory, const std::vector<CarriedBody>& bodies);

  /// The waypoints' times, and times between them so that no link rotates by more than 1 rad from one to the next and
  /// its poses define the direction of rotation. Whole revolutions of joints count.
  /// @throws std::invalid_argument if that takes more than 2000 added times, some 300 revolutions.
  std::vector<double> waypoints() const;

  /// Per body: bound on the deviation of the points of its ball due to joint_error [m]: the sum of joint_error times
  /// the reach of what the joint carries for rotating joints, and of joint_error itself for prismatic ones.
  std::vector<double> jointErrors() const;

  /// For sampleMotion(), at waypoints(); poses are those of CarriedBody, in the world. It refers to this object.
  /// Between times on both sides of a waypoint the jerk is infinite: nothing is bounded.
  MotionSource source();

 private:
  /// Motion of a frame in its parent frame between two waypoints: x ↦ t + R x.
  struct FrameMove {
    Isometry3d X_start = Isometry3d::Identity();
    Vector3d t_end = Vector3d::Zero();  ///< [m]
    double angle = 0.0;                 ///< of the rotation R [rad]

    bool rests() const { return angle == 0.0 && t_end == X_start.translation(); }
  };

  void posesAt(double time, std::vector<Isometry3d>& X_WB) const;
  void jerkBounds(double start, double end, std::vector<double>& jerk);
  double jerk(const CarriedBody& body, double share) const;
  void moveAlong(std::size_t segment, std::vector<FrameMove>& moves) const;

  const RobotModel& robot_;
  RobotTrajectory trajectory_;
  std::vector<CarriedBody> bodies_;
  std::size_t segment_ = 0;       // of moves_, by its last waypoint; 0: none
  std::vector<FrameMove> moves_;  // per link: of its joint; of the root: in the world
};

}  // namespace sdf_ccd
