#pragma once

#include <cstddef>
#include <vector>

#include "sdf_ccd/motion/sample_motion.h"
#include "sdf_ccd/robot/robot_trajectory.h"

namespace sdf_ccd {

/// The motion of bodies that a robot carries along a trajectory, with a bound of what happens between two times: from
/// the joints' rates and reaches along each body's chain (ChainDerivatives), whatever the poses at these times are.
///
/// A joint that rests adds nothing, and what lies between two joints that move counts as one piece. So a body that only
/// slides has a jerk of 0; of one that turns about one joint the bound is exact if its ball is centred on a plane
/// through that joint's origin across the axis.
class TrajectoryMotion {
 public:
  /// @param robot  must outlive this.
  /// @throws std::invalid_argument if there are fewer than two waypoints, times do not increase, states do not name the
  /// same joints, or a pose and the next one are kAmbiguousTurn apart; also as forwardKinematics() does.
  TrajectoryMotion(const RobotModel& robot, const RobotTrajectory& trajectory, const std::vector<CarriedBody>& bodies);

  /// The waypoints' times, and so many between them that no link turns by more than 1 rad from one to the next, so that
  /// its poses there tell which way it turned. Whole revolutions of joints count.
  /// @throws std::invalid_argument if that takes more than 2000 added times, some 300 revolutions.
  std::vector<double> waypoints() const;

  /// Per body: no point of its ball is farther than this from where the trajectory has it, by its joint_error [m]: of a
  /// joint that turns, that times the reach of what it carries; of one that slides, that itself; all added up.
  std::vector<double> jointErrors() const;

  /// For sampleMotion(), at waypoints(); poses are those of CarriedBody, in the world. It refers to this object.
  /// Between times on both sides of a waypoint nothing is bounded: the jerk is infinite.
  MotionSource source();

 private:
  /// How a frame moves in the one that it is given in, between two waypoints: x ↦ t + R x.
  struct FrameMove {
    Isometry3d X_start = Isometry3d::Identity();
    Vector3d t_end = Vector3d::Zero();  ///< [m]
    double angle = 0.0;                 ///< that R turns by [rad]

    bool rests() const { return angle == 0.0 && t_end == X_start.translation(); }
  };

  void posesAt(double time, std::vector<Isometry3d>& X_WB) const;
  void jerkBounds(double start, double end, std::vector<double>& jerk);
  double jerk(const CarriedBody& body, double share) const;
  void moveAlong(std::size_t segment, std::vector<FrameMove>& moves) const;

  const RobotModel& robot_;
  RobotTrajectory trajectory_;
  std::vector<CarriedBody> bodies_;
  std::size_t segment_ = 0;       // that moves_ is of, by its last waypoint; 0: of none
  std::vector<FrameMove> moves_;  // per link: of its joint; of the root: in the world
};

}  // namespace sdf_ccd
