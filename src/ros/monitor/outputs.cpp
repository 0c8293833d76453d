#include "ros/monitor/outputs.h"

#include <algorithm>

#include <ros/console.h>

#include "monitor/scene_difference.h"
#include "ros/messages/contact_states.h"
#include "ros/messages/shape_marker.h"
#include "ros/messages/world_markers.h"
#include "ros/monitor/cycle_messages.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kQueue = 8;  // maximum number of cycles whose messages wait to be published
const ros::WallDuration kCountPeriod(0.02);
const ros::WallDuration kWorldPeriod(1.0);

}  // namespace

Outputs::Outputs(const ros::NodeHandle& private_node, const ros::Publisher& state, const ros::Publisher& world,
                 MonitorLoop& loop, const DescribedScene& described, const MarkerOptions& options,
                 ProximityOutputs& proximity)
    : node_(private_node),
      loop_(loop),
      proximity_(proximity),
      state_(state),
      world_publisher_(world),
      torques_(described),
      marker_options_(options),
      drawer_(loop.fixedFrame(), options) {
  contacts_ = node_.advertise<ContactArray>("contacts", 100);
  contact_states_ = node_.advertise<gazebo_msgs::ContactsState>("contact_states", 100);
  markers_ = node_.advertise<visualization_msgs::MarkerArray>("markers", 10);
  links_ = node_.advertise<visualization_msgs::MarkerArray>("links", 10, true);
  torques_.advertise(node_);
  adopt(*prepare(*loop.world()));
  setDrawnWorld(loop.world());
  worker_ = std::make_unique<OrderedWorker<Report>>(kQueue, [this](Report& report) { send(report); });
}

Outputs::~Outputs() = default;

std::unique_ptr<Outputs::Change> Outputs::prepare(const CheckedWorld& next) {
  auto change = std::make_unique<Change>();
  change->link_of_body = torques_.linksOf(next.scene());
  const BodyList& bodies = next.scene().bodies;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies[body].is_world) continue;
    const std::string topic = wrenchTopic(bodies[body]);
    const auto known =
        std::find_if(wrenches_.begin(), wrenches_.end(), [&](const LinkWrench& link) { return link.topic == topic; });
    LinkWrench link{static_cast<int>(body), topic, {}, false, {}};
    if (known != wrenches_.end()) {
      link.publisher = known->publisher;
      link.messages = known->messages;
    } else {
      link.publisher = node_.advertise<geometry_msgs::WrenchStamped>(topic, 100);
      link.messages = std::make_shared<MessagePool<geometry_msgs::WrenchStamped>>();
    }
    change->wrenches.push_back(std::move(link));
  }
  return change;
}

void Outputs::adopt(Change& change) {
  wrenches_.swap(change.wrenches);
  torques_.swapLinks(change.link_of_body);
}

CycleRequest Outputs::request(int max_points) {
  countSubscribers();
  CycleRequest request;
  request.wrenches = contacts_wanted_ || wrenches_wanted_ || torques_wanted_ || state_wanted_;
  request.contacts = contacts_wanted_ || markers_wanted_ || state_wanted_;
  request.max_points = contacts_wanted_ || markers_wanted_ ? max_points : 0;
  // The status text and the state report the clearance of all pairs.
  request.skipped_pairs = markers_wanted_ || links_wanted_ || state_wanted_ || proximity_.isWanted();
  return request;
}

/// Counting searches all topics of the process, so it is not done in each cycle.
void Outputs::countSubscribers() {
  const ros::WallTime now = ros::WallTime::now();
  if (now - counted_at_ < kCountPeriod) return;
  counted_at_ = now;
  contact_states_wanted_ = contact_states_.getNumSubscribers() > 0;
  contacts_wanted_ = contact_states_wanted_ || contacts_.getNumSubscribers() > 0;
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
  report.has_contact_states = contact_states_wanted_;
  if (torques_wanted_) report.torques = torques_.toMessage(loop_);
  report.draws_markers = markers_wanted_;
  report.draws_links = links_wanted_;
  report.marker_options = marker_options_;
  if (contacts_wanted_) {
    report.contacts = contact_messages_.take();
    setContactArray(loop_, *report.contacts);
  }
  for (std::size_t i = 0; i < wrenches_.size() && wrenches_wanted_; ++i) {
    LinkWrench& link = wrenches_[i];
    if (!link.is_wanted || !loop_.cycle().motion.missing[link.body].empty()) continue;
    report.wrenches.emplace_back(link.publisher, link.messages->take());
    setWrenchStamped(loop_, link.body, *report.wrenches.back().second);
  }
  if (report.draws_markers || report.draws_links) report.snapshot.take(loop_);
  setWorld(report);
  worker_->handOver();
}

void Outputs::publishUnchecked(const std::string& reason, const boost::shared_ptr<MonitorState>& state) {
  countSubscribers();
  Report& report = worker_->next();
  report.is_unchecked = true;
  report.has_contact_states = false;
  report.reason = reason;
  report.state = state;
  report.draws_links = links_wanted_;
  if (contacts_wanted_) report.contacts = boost::make_shared<ContactArray>(toUncheckedContacts(loop_, reason));
  setWorld(report);
  worker_->handOver();
}

/// Drawing large worlds takes a while, so it waits for a subscriber.
void Outputs::setWorld(Report& report) {
  const ros::WallTime now = ros::WallTime::now();
  report.draws_world = false;
  if (loop_.world()->version() != world_drawn_ && (world_drawn_ == 0 || now - world_drawn_at_ > kWorldPeriod))
    report.draws_world = world_publisher_.getNumSubscribers() > 0;
  if (report.draws_world) {
    world_drawn_ = loop_.world()->version();
    world_drawn_at_ = now;
  }
  if (report.draws_markers || report.draws_links || report.draws_world) report.world = loop_.world();
}

/// Called by the drawing thread.
void Outputs::setDrawnWorld(const std::shared_ptr<const CheckedWorld>& world) {
  if (world == drawn_) return;
  if (drawn_) drawer_.take(findPairs(pairNames(world->scene()), pairNames(drawn_->scene())));
  link_markers_ = std::make_unique<LinkMarkers>(world->description());
  drawn_ = world;
}

void Outputs::finish() {
  is_finishing_ = true;
  worker_.reset();
}

void Outputs::send(Report& report) {
  try {
    if (report.contacts) contacts_.publish(report.contacts);
    if (report.contacts && report.has_contact_states) contact_states_.publish(toContactStates(*report.contacts));
    for (const auto& [publisher, wrench] : report.wrenches) publisher.publish(wrench);
    if (report.state) state_.publish(report.state);
    if (report.torques) torques_.publish(report.torques);
    if (report.distances) proximity_.publishDistances(report.distances);
    draw(report);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(1.0, "Messages of a cycle could not be published: %s", error.what());
  }
  report.contacts.reset();
  report.state.reset();
  report.distances.reset();
  report.torques.reset();
  report.wrenches.clear();
  report.world.reset();
  report.snapshot.release();
}

void Outputs::draw(const Report& report) {
  if (report.world) setDrawnWorld(report.world);
  if (report.draws_world) drawWorld(*report.world);
  if (report.is_unchecked) {
    markers_.publish(boost::make_shared<visualization_msgs::MarkerArray>(drawer_.clear(report.reason)));
  } else if (is_finishing_ || (!report.draws_markers && !report.draws_links)) {
    return;
  } else {
    drawer_.setOptions(report.marker_options);
    const auto markers = boost::make_shared<visualization_msgs::MarkerArray>(
        drawer_.draw(report.snapshot.result(), report.snapshot.context(), ros::Time::now()));
    if (report.draws_markers) markers_.publish(markers);
  }
  if (report.draws_links) drawLinks();
}

void Outputs::drawWorld(const CheckedWorld& world) {
  const auto markers = boost::make_shared<visualization_msgs::MarkerArray>(toWorldMarkers(world.description()));
  if (has_drawn_world_)  // deletes objects that no longer exist
    markers->markers.insert(markers->markers.begin(), deleteAllMarker(loop_.fixedFrame()));
  has_drawn_world_ = true;
  world_publisher_.publish(markers);
}

void Outputs::drawLinks() {
  constexpr double kAgain = 2.0;  // rviz drops markers for good whose frames it does not know yet [s]
  const ros::WallTime now = ros::WallTime::now();
  const bool has_changed = link_markers_->draw(drawer_.states().ofBodies(drawn_->scene()));
  if (!has_changed && (now - links_drawn_at_).toSec() < kAgain) return;
  links_drawn_at_ = now;
  links_.publish(boost::make_shared<visualization_msgs::MarkerArray>(link_markers_->markers()));
}

}  // namespace sdf_ccd
