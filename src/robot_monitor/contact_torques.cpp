#include "contact_torques.h"

#include <algorithm>
#include <limits>

namespace sdf_ccd {

ContactTorques::ContactTorques(const RobotModel& robot)
    : torques_(robot),
      X_WL_(robot.links().size(), Isometry3d::Identity()),
      wrenches_(robot.links().size()),
      is_known_(robot.links().size()) {}

void ContactTorques::setPose(int link, const Isometry3d& X_WL) {
  X_WL_[link] = X_WL;
  is_known_[link] = 1;
}

/// Adds what a pair does to one of its bodies.
void ContactTorques::add(const Scene& scene, const CycleMotion& motion, int body, const PairResult& pair) {
  const Wrench& wrench = body == pair.body_a ? pair.on_a_W : pair.on_b_W;
  const int link = link_of_body_[body];
  if (link < 0 || (wrench.force.isZero(0.0) && wrench.torque.isZero(0.0))) return;
  const Isometry3d& X_WB_then = motion.pose(body, pair.span.last);
  const Isometry3d X_WL_then = X_WB_then * scene.bodies[body].X_frame_B.inverse();
  if (!is_known_[link]) setPose(link, X_WL_then);  // it has no moving joint directly above it
  // A pair may have been checked until an earlier time than others. What acted on the link then does so now, as seen
  // from the link: the torque at the joint above it is that of then.
  const Matrix3d rotation = X_WL_[link].linear() * X_WL_then.linear().transpose();
  const Vector3d lever = X_WB_then.translation() - X_WL_then.translation();
  wrenches_[link].force += rotation * wrench.force;
  wrenches_[link].torque += rotation * (wrench.torque + lever.cross(wrench.force));
}

void ContactTorques::compute(const Scene& scene, const CycleMotion& motion, const std::vector<PairResult>& pairs,
                             std::vector<double>& torques) {
  std::fill(wrenches_.begin(), wrenches_.end(), Wrench());
  for (const PairResult& pair : pairs) {
    if (pair.span.empty()) continue;
    add(scene, motion, pair.body_a, pair);
    add(scene, motion, pair.body_b, pair);
  }
  torques_.compute(X_WL_, wrenches_, torques);
  for (const auto& [link, joint] : torques_.jointsBelow())
    if (!is_known_[link]) torques[joint] = std::numeric_limits<double>::quiet_NaN();
  std::fill(is_known_.begin(), is_known_.end(), 0);
}

}  // namespace sdf_ccd
