#include "ros/outputs.h"

#include <algorithm>

#include <ros/console.h>

#include "ros/cycle_messages.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kWaiting = 8;  // cycles whose messages may wait
const ros::WallDuration kLookPeriod(0.02);

}  // namespace

Outputs::Outputs(ros::NodeHandle private_node, const ros::Publisher& state, MonitorLoop& loop,
                 const DescribedScene& described, const MarkerOptions& options, ProximityOutputs& proximity)
    : loop_(loop),
      scene_(loop.scene()),
      proximity_(proximity),
      drawer_(loop.fixedFrame(), options),
      link_markers_(described.scene),
      torques_(described, scene_),
      state_(state) {
  contacts_ = private_node.advertise<ContactArray>("contacts", 100);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>("markers", 10);
  torques_.advertise(private_node);
  links_ = private_node.advertise<visualization_msgs::MarkerArray>("links", 10, true);
  for (std::size_t body = 0; body < scene_.bodies.size(); ++body) {
    if (scene_.bodies[body].is_world) continue;
    LinkWrench link;
    link.body = static_cast<int>(body);
    link.publisher = private_node.advertise<geometry_msgs::WrenchStamped>(wrenchTopic(scene_.bodies[body]), 100);
    wrenches_.push_back(link);
  }
  worker_ = std::make_unique<OrderedWorker<Report>>(kWaiting, [this](Report& report) { send(report); });
}

CycleRequest Outputs::request(int max_points) {
  lookForSubscribers();
  CycleRequest request;
  request.wrenches = contacts_wanted_ || wrenches_wanted_ || torques_wanted_ || state_wanted_;
  request.contacts = contacts_wanted_ || markers_wanted_ || state_wanted_;
  request.max_points = contacts_wanted_ || markers_wanted_ ? max_points : 0;
  // The status, and the state, tell the clearance of all.
  request.skipped_pairs = markers_wanted_ || links_wanted_ || state_wanted_ || proximity_.isWanted();
  return request;
}

/// Each look searches all topics of the process, so that it is not taken every millisecond.
void Outputs::lookForSubscribers() {
  const ros::WallTime now = ros::WallTime::now();
  if (now - looked_ < kLookPeriod) return;
  looked_ = now;
  contacts_wanted_ = contacts_.getNumSubscribers() > 0;
  state_wanted_ = state_.getNumSubscribers() > 0;
  markers_wanted_ = markers_.getNumSubscribers() > 0;
  torques_wanted_ = torques_.isWanted();
  links_wanted_ = links_.getNumSubscribers() > 0;
  wrenches_wanted_ = false;
  for (LinkWrench& link : wrenches_) {
    link.is_wanted = link.publisher.getNumSubscribers() > 0;
    wrenches_wanted_ |= link.is_wanted;
  }
}

void Outputs::publish(const boost::shared_ptr<MonitorState>& state, const boost::shared_ptr<DistanceArray>& distances) {
  Report& report = worker_->next();
  report.is_unchecked = false;
  report.state = state;
  report.distances = distances;
  if (torques_wanted_) report.torques = torques_.toMessage(loop_);
  report.draws_markers = markers_wanted_;
  report.draws_links = links_wanted_;
  if (contacts_wanted_) {
    report.contacts = contact_messages_.take();
    setContactArray(loop_, *report.contacts);
  }
  for (std::size_t i = 0; i < wrenches_.size() && wrenches_wanted_; ++i) {
    LinkWrench& link = wrenches_[i];
    if (!link.is_wanted || !loop_.cycle().motion.missing[link.body].empty()) continue;
    report.wrenches.emplace_back(i, link.messages.take());
    setWrenchStamped(loop_, link.body, *report.wrenches.back().second);
  }
  if (report.draws_markers || report.draws_links) report.snapshot.take(loop_);
  worker_->handOver();
}

void Outputs::publishUnchecked(const std::string& reason, const boost::shared_ptr<MonitorState>& state) {
  lookForSubscribers();
  Report& report = worker_->next();
  report.is_unchecked = true;
  report.reason = reason;
  report.state = state;
  report.draws_links = links_wanted_;
  if (contacts_wanted_) report.contacts = boost::make_shared<ContactArray>(toUncheckedContacts(loop_, reason));
  worker_->handOver();
}

void Outputs::finish() {
  finishes_ = true;
  worker_.reset();
}

void Outputs::send(Report& report) {
  try {
    if (report.contacts) contacts_.publish(report.contacts);
    for (const auto& [link, wrench] : report.wrenches) wrenches_[link].publisher.publish(wrench);
    if (report.state) state_.publish(report.state);
    if (report.torques) torques_.publish(report.torques);
    if (report.distances) proximity_.publishDistances(report.distances);
    draw(report);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(1.0, "The messages of a cycle are not sent: %s", error.what());
  }
  report.contacts.reset();
  report.state.reset();
  report.distances.reset();
  report.torques.reset();
  report.wrenches.clear();
}

void Outputs::draw(const Report& report) {
  if (report.is_unchecked) {
    markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(drawer_.clear(report.reason)));
  } else if (finishes_ || (!report.draws_markers && !report.draws_links)) {
    return;
  } else {
    const auto markers = boost::make_shared<visualization_msgs::MarkerArray>(
        drawer_.draw(report.snapshot.result(), report.snapshot.context(), ros::Time::now()));
    if (report.draws_markers) markers_.publish(markers);
  }
  if (report.draws_links) drawLinks();
}

void Outputs::drawLinks() {
  auto drawn = link_markers_.draw(drawer_.states().ofBodies(scene_));
  if (drawn) links_.publish(boost::make_shared<visualization_msgs::MarkerArray>(std::move(*drawn)));
}

}  // namespace sdf_ccd
