#include "ros/outputs.h"

#include <algorithm>

#include "ros/cycle_messages.h"

namespace sdf_ccd {

Outputs::Outputs(ros::NodeHandle private_node, const MonitorLoop& loop, const SceneDescription& scene,
                 const MarkerOptions& options)
    : loop_(loop), drawer_(loop.fixedFrame(), options), link_markers_(scene) {
  contacts_ = private_node.advertise<ContactArray>("contacts", 100);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>("markers", 10);
  links_ = private_node.advertise<visualization_msgs::MarkerArray>("links", 10, true);
  const std::vector<Body>& bodies = loop_.scene().bodies;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies[body].is_world) continue;
    wrenches_.push_back(
        {static_cast<int>(body), private_node.advertise<geometry_msgs::WrenchStamped>(wrenchTopic(bodies[body]), 100)});
  }
}

CycleRequest Outputs::request(int max_points) const {
  const bool contacts = contacts_.getNumSubscribers() > 0;
  CycleRequest request;
  request.wrenches = contacts || std::any_of(wrenches_.begin(), wrenches_.end(), [](const LinkWrench& link) {
                       return link.publisher.getNumSubscribers() > 0;
                     });
  request.contacts = contacts || markers_.getNumSubscribers() > 0;
  request.max_points = request.contacts ? max_points : 0;
  return request;
}

void Outputs::publish() {
  if (contacts_.getNumSubscribers() > 0) contacts_.publish(toContactArray(loop_));
  publishWrenches();
  publishMarkers();
}

void Outputs::publishMarkers() {
  const bool links = links_.getNumSubscribers() > 0, contacts = markers_.getNumSubscribers() > 0;
  if (!links && !contacts) return;
  const visualization_msgs::MarkerArray markers = drawer_.draw(loop_.result(), contextOf(loop_), ros::Time::now());
  if (contacts) markers_.publish(markers);
  if (!links) return;
  if (const auto drawn = link_markers_.draw(drawer_.states().ofBodies(loop_.scene()))) links_.publish(*drawn);
}

void Outputs::publishWrenches() const {
  for (const LinkWrench& link : wrenches_) {
    if (link.publisher.getNumSubscribers() == 0 || !loop_.cycle().motion.missing[link.body].empty()) continue;
    link.publisher.publish(toWrenchStamped(loop_, link.body));
  }
}

void Outputs::publishUnchecked(const std::string& reason) {
  if (contacts_.getNumSubscribers() > 0) contacts_.publish(toUncheckedContacts(loop_, reason));
  markers_.publish(drawer_.clear(reason));
  if (links_.getNumSubscribers() == 0) return;
  if (const auto drawn = link_markers_.draw(drawer_.states().ofBodies(loop_.scene()))) links_.publish(*drawn);
}

}  // namespace sdf_ccd
