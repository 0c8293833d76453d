#pragma once

#include <vector>

#include "robot/joint_torques.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// The forces and torques of a cycle's contact wrenches at the robot's joints, as JointTorques has them. Its memory is
/// reused.
class ContactTorques {
 public:
  explicit ContactTorques(const RobotModel& robot);

  const std::vector<std::string>& joints() const { return torques_.joints(); }

  /// The links whose poses are needed: see JointTorques.
  const std::vector<int>& links() const { return torques_.links(); }

  /// Exchanges, per body, the index of the link that carries it; −1: none.
  void swapLinks(std::vector<int>& link_of_body) { link_of_body_.swap(link_of_body); }

  /// To be called for each of links() whose pose is known, before compute(), which forgets it.
  void setPose(int link, const Isometry3d& X_WL);

  /// @param scene    of the last swapLinks().
  /// @param motion   X_WB of its bodies.
  /// @param torques  per joint [N·m], or [N]; NaN of a joint above a link whose pose is not known.
  void compute(const Scene& scene, const CycleMotion& motion, const std::vector<PairResult>& pairs,
               std::vector<double>& torques);

 private:
  void add(const Scene& scene, const CycleMotion& motion, int body, const PairResult& pair);

  JointTorques torques_;
  std::vector<int> link_of_body_;
  std::vector<Isometry3d> X_WL_;  // per link
  std::vector<Wrench> wrenches_;  // per link: about its origin, world axes
  std::vector<char> is_known_;    // per link: its pose
};

}  // namespace sdf_ccd
