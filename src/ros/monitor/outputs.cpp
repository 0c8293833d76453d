#include "ros/monitor/outputs.h"

#include <algorithm>
#include <iterator>
#include <set>

#include <ros/console.h>

#include "ros/messages/contact_states.h"
#include "ros/monitor/cycle_messages.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kQueue = 8;  // maximum number of cycles whose messages wait to be published
const ros::WallDuration kCountPeriod(0.02);

/// Per body: of all of its pairs.
std::vector<char> areForcesKnown(const Scene& scene) {
  std::vector<char> known(scene.bodies.size(), 1);
  for (const PlannedPair& pair : scene.pairs) {
    const bool are_known =
        scene.bodies[pair.body_a].forces == Forces::kKnown && scene.bodies[pair.body_b].forces == Forces::kKnown;
    if (!are_known) known[static_cast<std::size_t>(pair.body_a)] = known[static_cast<std::size_t>(pair.body_b)] = 0;
  }
  return known;
}

}  // namespace

Outputs::Outputs(const ros::NodeHandle& private_node, const ros::Publisher& state, const ros::Publisher& world,
                 MonitorLoop& loop, const DescribedScene& described, const MarkerOptions& options,
                 ProximityOutputs& proximity)
    : node_(private_node),
      loop_(loop),
      proximity_(proximity),
      state_(state),
      torques_(described),
      markers_(private_node, world, loop, options) {
  contacts_ = node_.advertise<ContactArray>("contacts", 100);
  contact_states_ = node_.advertise<gazebo_msgs::ContactsState>("contact_states", 100);
  torques_.advertise(node_);
  advertise(loop.world()->description(), {});
  adopt(*prepare(*loop.world()));
  worker_ = std::make_unique<OrderedWorker<Report>>(kQueue, [this](Report& report) { send(report); });
}

Outputs::~Outputs() = default;

void Outputs::advertise(const SceneDescription& next, const SceneDescription& present) {
  std::set<std::string> of_next, used;
  for (const SceneDescription* const scene : {&next, &present})
    for (const BodyDescription& body : scene->bodies)
      if (!body.is_world) (scene == &next ? of_next : used).insert(wrenchTopic(body));
  used.insert(of_next.begin(), of_next.end());
  std::vector<WrenchTopic> dropped;  // without the lock, as the master is told
  {
    const std::lock_guard<std::mutex> lock(topics_mutex_);
    for (auto topic = topics_.begin(); topic != topics_.end();) {
      of_next.erase(topic->first);
      const bool is_used = used.count(topic->first) > 0;
      if (!is_used) dropped.push_back(std::move(topic->second));
      topic = is_used ? std::next(topic) : topics_.erase(topic);
    }
  }
  for (const std::string& name : of_next) {
    const WrenchTopic topic{node_.advertise<geometry_msgs::WrenchStamped>(name, 100),
                            std::make_shared<MessagePool<geometry_msgs::WrenchStamped>>()};
    const std::lock_guard<std::mutex> lock(topics_mutex_);
    topics_[name] = topic;
  }
}

std::unique_ptr<Outputs::Change> Outputs::prepare(const CheckedWorld& next) {
  auto change = std::make_unique<Change>();
  change->link_of_body = torques_.linksOf(next.scene());
  const BodyList& bodies = next.scene().bodies;
  const std::vector<char> is_ready = areForcesKnown(next.scene());
  change->are_all_ready = std::all_of(is_ready.begin(), is_ready.end(), [](char ready) { return ready; });
  const std::lock_guard<std::mutex> lock(topics_mutex_);
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies[body].is_world) continue;
    const auto topic = topics_.find(wrenchTopic(bodies[body]));
    if (topic != topics_.end())
      change->wrenches.push_back({topic->second, static_cast<int>(body), is_ready[body] != 0});
  }
  return change;
}

void Outputs::adopt(Change& change) {
  wrenches_.swap(change.wrenches);
  torques_.swapLinks(change.link_of_body);
  are_all_ready_ = change.are_all_ready;
}

CycleRequest Outputs::request(int max_points) {
  countSubscribers();
  const bool wants_state = state_wanted_ || ros::WallTime::now() >= state_due_;
  CycleRequest request;
  const bool wants_wrenches = contacts_wanted_ || wrenches_wanted_ || torques_wanted_;
  if (wants_wrenches || markers_.wantsMarkers()) have_wanted_wrenches_ = true;
  request.wrenches = wants_wrenches || wants_state;
  request.contacts = contacts_wanted_ || markers_.wantsMarkers() || wants_state;
  request.max_points = contacts_wanted_ || markers_.wantsMarkers() ? max_points : 0;
  // The status text and the state report the clearance of all pairs.
  request.skipped_pairs = markers_.wantsMarkers() || markers_.wantsLinks() || wants_state || proximity_.isWanted();
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
  torques_wanted_ = torques_.isWanted();
  markers_.countSubscribers();
  wrenches_wanted_ = false;
  for (LinkWrench& link : wrenches_) {
    link.is_wanted = link.publisher.getNumSubscribers() > 0;
    wrenches_wanted_ |= link.is_wanted;
  }
}

/// Whether the state is published: to subscribers always; else if it has all numbers. Without them, a change is
/// published after the next cycle, which has them.
bool Outputs::isDue(const MonitorState& state) {
  constexpr double kPeriod = 1.0;  // [s]
  if (!state_wanted_ && !hasScalars(loop_)) {
    if (state.verdict != verdict_ || state.proximity != proximity_level_) state_due_ = ros::WallTime();
    return false;
  }
  verdict_ = state.verdict;
  proximity_level_ = state.proximity;
  state_due_ = ros::WallTime::now() + ros::WallDuration(kPeriod);
  return true;
}

void Outputs::publish(const boost::shared_ptr<MonitorState>& state, const boost::shared_ptr<DistanceArray>& distances) {
  Report& report = worker_->next();
  if (isDue(*state)) report.state = state;
  report.distances = distances;
  report.has_contact_states = contact_states_wanted_;
  if (torques_wanted_ && are_all_ready_) report.torques = torques_.toMessage(loop_);
  if (contacts_wanted_) {
    report.contacts = contact_messages_.acquire();
    setContactArray(loop_, *report.contacts);
  }
  for (std::size_t i = 0; i < wrenches_.size() && wrenches_wanted_; ++i) {
    LinkWrench& link = wrenches_[i];
    if (!link.is_wanted || !link.is_ready || !loop_.cycle().motion.missing[link.body].empty()) continue;
    report.wrenches.emplace_back(link.publisher, link.messages->acquire());
    setWrenchStamped(loop_, link.body, *report.wrenches.back().second);
  }
  worker_->handOver();
  markers_.draw();
}

void Outputs::publishUnchecked(const std::string& reason, const boost::shared_ptr<MonitorState>& state) {
  countSubscribers();
  Report& report = worker_->next();
  report.has_contact_states = false;
  report.state = state;
  state_due_ = ros::WallTime();  // the first cycle after it
  if (contacts_wanted_) report.contacts = boost::make_shared<ContactArray>(toUncheckedContacts(loop_, reason));
  worker_->handOver();
  markers_.drawUnchecked(reason);
}

void Outputs::finish() {
  worker_.reset();
  markers_.finish();
}

void Outputs::send(Report& report) {
  try {
    if (report.contacts) contacts_.publish(report.contacts);
    if (report.contacts && report.has_contact_states) contact_states_.publish(toContactStates(*report.contacts));
    for (const auto& [publisher, wrench] : report.wrenches) publisher.publish(wrench);
    if (report.state) state_.publish(report.state);
    if (report.torques) torques_.publish(report.torques);
    if (report.distances) proximity_.publishDistances(report.distances);
  } catch (const std::exception& error) {
    ROS_ERROR_THROTTLE(1.0, "Messages of a cycle could not be published: %s", error.what());
  }
  report.contacts.reset();
  report.state.reset();
  report.distances.reset();
  report.torques.reset();
  report.wrenches.clear();
}

}  // namespace sdf_ccd
