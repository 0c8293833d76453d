#include "ros/monitor/torque_output.h"

#include <algorithm>

#include "ros/tf/seconds_between.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

namespace {

std::vector<std::string> framesOf(const ContactTorques& torques, const std::vector<std::string>& frames) {
  std::vector<std::string> needed;
  for (const int link : torques.links()) needed.push_back(frames[link]);
  return needed;
}

}  // namespace

TorqueOutput::TorqueOutput(const DescribedScene& described)
    : torques_(*described.robot), frames_(described.frames().all()), chains_(framesOf(torques_, frames_)) {}

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
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (!window_.problem(i).empty() || parts_[i].until < cycle.origin) continue;
    torques_.setPose(torques_.links()[i], window_.pose(i, secondsBetween(cycle.origin, parts_[i].until)));
  }
}

void TorqueOutput::set(MonitorLoop& loop, sensor_msgs::JointState& message) {
  const TrackedCycle& cycle = loop.cycle();
  findLinks(loop.history(), cycle);
  message.header.stamp = cycle.end;
  message.header.frame_id.clear();
  message.name = torques_.joints();
  torques_.compute(loop.scene(), cycle.motion, loop.result().pairs, message.effort);
}

}  // namespace sdf_ccd
