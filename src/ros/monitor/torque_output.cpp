#include "ros/monitor/torque_output.h"

#include <algorithm>
#include <limits>

#include "ros/tf/seconds_between.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

namespace {

std::vector<std::string> framesOf(const JointTorques& torques, const std::vector<std::string>& frames) {
  std::vector<std::string> needed;
  for (const int link : torques.links()) needed.push_back(frames[link]);
  return needed;
}

}  // namespace

TorqueOutput::TorqueOutput(const DescribedScene& described)
    : torques_(*described.robot), frames_(described.frames().all()), chains_(framesOf(torques_, frames_)) {
  X_WL_.assign(frames_.size(), Isometry3d::Identity());
  wrenches_.resize(frames_.size());
  is_known_.resize(frames_.size());
}

std::vector<int> TorqueOutput::linksOf(const Scene& scene) const {
  std::vector<int> links;
  for (const Body& body : scene.bodies) {
    const auto link = std::find(frames_.begin(), frames_.end(), withoutLeadingSlash(body.frame));
    const bool is_carried = !body.is_world && link != frames_.end();
    links.push_back(is_carried ? static_cast<int>(link - frames_.begin()) : -1);
  }
  return links;
}

void TorqueOutput::advertise(ros::NodeHandle private_node) {
  publisher_ = private_node.advertise<sensor_msgs::JointState>("joint_torques", 100);
}

boost::shared_ptr<sensor_msgs::JointState> TorqueOutput::toMessage(MonitorLoop& loop) {
  const boost::shared_ptr<sensor_msgs::JointState> message = messages_.acquire();
  set(loop, *message);
  return message;
}

/// Finds the poses of the links that the torques need, in memory that is reused. A link whose transforms are late is
/// taken where it was when its pairs were last checked.
void TorqueOutput::findLinks(const TfHistory& history, const TrackedCycle& cycle) {
  history.spans(chains_, spans_);
  parts_.clear();
  for (const TfSpan& span : spans_) {
    const bool is_late = span.problem.empty() && !span.is_static && span.last < cycle.end;
    const ros::Time& time = is_late ? span.last : cycle.end;
    parts_.push_back({time, time});
  }
  history.copy(chains_, parts_, cycle.origin, window_);
  std::fill(is_known_.begin(), is_known_.end(), 0);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const int link = torques_.links()[i];
    is_known_[link] = window_.problem(i).empty() && parts_[i].until >= cycle.origin;
    if (is_known_[link]) X_WL_[link] = window_.pose(i, secondsBetween(cycle.origin, parts_[i].until));
  }
}

void TorqueOutput::set(MonitorLoop& loop, sensor_msgs::JointState& message) {
  const TrackedCycle& cycle = loop.cycle();
  std::fill(wrenches_.begin(), wrenches_.end(), Wrench());
  findLinks(loop.history(), cycle);
  const auto add = [&](int body, std::size_t end, const Wrench& wrench) {
    const int link = link_of_body_[body];
    if (link < 0 || (wrench.force.isZero(0.0) && wrench.torque.isZero(0.0))) return;
    const Isometry3d X_WL_then = cycle.motion.pose(body, end) * loop.scene().bodies[body].X_frame_B.inverse();
    if (!is_known_[link]) {  // it has no moving joint directly above it: its body's pose is used
      X_WL_[link] = X_WL_then;
      is_known_[link] = 1;
    }
    // A pair may have been checked until an earlier time than others. What acted on the link then does so now, as seen
    // from the link: the torque at the joint above it is that of then.
    const Matrix3d turn = X_WL_[link].linear() * X_WL_then.linear().transpose();
    const Vector3d lever = cycle.motion.pose(body, end).translation() - X_WL_then.translation();
    wrenches_[link].force += turn * wrench.force;
    wrenches_[link].torque += turn * (wrench.torque + lever.cross(wrench.force));
  };
  for (const PairResult& pair : loop.result().pairs) {
    if (pair.span.empty()) continue;
    add(pair.body_a, pair.span.last, pair.on_a_W);
    add(pair.body_b, pair.span.last, pair.on_b_W);
  }
  message.header.stamp = cycle.end;
  message.header.frame_id.clear();
  message.name = torques_.joints();
  torques_.compute(X_WL_, wrenches_, message.effort);
  for (const auto& [link, joint] : torques_.jointsBelow()) {
    if (!is_known_[link]) message.effort[joint] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace sdf_ccd
