#include "ros/outputs.h"

#include <algorithm>
#include <cctype>

#include <geometry_msgs/WrenchStamped.h>

namespace sdf_ccd {
namespace {

/// Link names may hold characters that names of topics may not.
std::string toTopicName(std::string link) {
  std::replace_if(
      link.begin(), link.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_' && c != '/'; }, '_');
  return link;
}

}  // namespace

Outputs::Outputs(ros::NodeHandle private_node, std::shared_ptr<const Scene> scene, const std::string& fixed_frame,
                 const MarkerOptions& options)
    : scene_(std::move(scene)), fixed_frame_(fixed_frame), drawer_(fixed_frame, options) {
  contacts_ = private_node.advertise<ContactArray>("contacts", 100);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>("markers", 10);
  for (std::size_t body = 0; body < scene_->bodies.size(); ++body) {
    if (scene_->bodies[body].is_world) continue;
    const std::string topic = "wrenches/" + toTopicName(scene_->bodies[body].name);
    wrenches_.push_back({static_cast<int>(body), private_node.advertise<geometry_msgs::WrenchStamped>(topic, 100)});
  }
}

CycleRequest Outputs::request(int max_points) const {
  const bool contacts = contacts_.getNumSubscribers() > 0;
  CycleRequest request;
  request.wrenches = contacts || std::any_of(wrenches_.begin(), wrenches_.end(), [](const LinkWrench& link) {
                       return link.publisher.getNumSubscribers() > 0;
                     });
  request.max_points = contacts || markers_.getNumSubscribers() > 0 ? max_points : 0;
  return request;
}

void Outputs::publish(const CycleResult& result, const TrackedCycle& cycle) {
  const CycleContext context{*scene_, cycle.motion, cycle.samples, cycle.origin};
  if (contacts_.getNumSubscribers() > 0) {
    ContactArray contacts = toContactArray(result, context);
    contacts.header.stamp = cycle.end;
    contacts.header.frame_id = fixed_frame_;
    contacts.cycle_start = cycle.start;
    contacts.complete_until = cycle.complete_until;
    contacts_.publish(contacts);
  }
  publishWrenches(result, cycle);
  if (markers_.getNumSubscribers() > 0) {
    const visualization_msgs::MarkerArray markers = drawer_.draw(result, context);
    if (!markers.markers.empty()) markers_.publish(markers);
  }
}

void Outputs::publishWrenches(const CycleResult& result, const TrackedCycle& cycle) const {
  for (const LinkWrench& link : wrenches_) {
    if (link.publisher.getNumSubscribers() == 0 || !cycle.motion.missing[link.body].empty()) continue;
    Wrench sum_W;
    for (const PairResult& pair : result.pairs) {
      if (pair.body_a == link.body) sum_W += pair.on_a_W;
      if (pair.body_b == link.body) sum_W += pair.on_b_W;
    }
    const Isometry3d R_WB(cycle.motion.X_WB[link.body].back().linear());
    geometry_msgs::WrenchStamped message;
    message.header.stamp = cycle.end;
    message.header.frame_id = scene_->bodies[link.body].frame;
    message.wrench = toWrench(expressedIn(R_WB, sum_W));
    link.publisher.publish(message);
  }
}

void Outputs::clear() {
  markers_.publish(drawer_.clear());
}

}  // namespace sdf_ccd
