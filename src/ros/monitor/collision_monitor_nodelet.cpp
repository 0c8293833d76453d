#include "ros/monitor/collision_monitor_nodelet.h"

#include <pthread.h>

#include <filesystem>

#include <ros/package.h>
#include <pluginlib/class_list_macros.hpp>

#include "common/cancel_point.h"
#include "common/counted.h"
#include "common/number_text.h"
#include "monitor/map/map_distances.h"
#include "ros/messages/world_markers.h"
#include "ros/monitor/cycle_messages.h"
#include "scene/geometry_keys.h"

namespace sdf_ccd {
namespace {

constexpr double kIdlePeriod = 1.0;  // [s]
constexpr double kLogPeriod = 3.0;   // between log messages about the progress of building [s]
constexpr double kFlushTime = 0.05;  // for sending the last messages [s]

}  // namespace

CollisionMonitor::~CollisionMonitor() {
  stop_ = true;
  trigger_.stop();
  if (thread_.joinable()) thread_.join();
  watchdog_.reset();
  if (ros::ok()) {
    if (loop_) loop_->reset();
    publishUnchecked("the monitor has ended");
    if (outputs_) outputs_->finish();
    ros::WallDuration(kFlushTime).sleep();
  }
  if (services_) services_->stop();
  reconfiguration_.reset();
  force_builder_.reset();
  live_map_.reset();
  scene_editor_.reset();
  queries_.reset();
  outputs_.reset();
  proximity_.reset();
  loop_.reset();
  first_world_.reset();
  world_editor_.reset();
  described_ = {};
}

void CollisionMonitor::onInit() {
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  state_publisher_ = private_node.advertise<MonitorState>("state", 100, true);
  plan_ = std::make_unique<PlanPublisher>(private_node);
  world_publisher_ = private_node.advertise<visualization_msgs::MarkerArray>("world", 1, true);
  diagnostics_ = std::make_unique<Diagnostics>(getNodeHandle(), private_node, getName());
  services_ = std::make_unique<MonitorServices>(private_node, stop_);
  thread_ = std::thread([this] { run(); });
}

void CollisionMonitor::run() {
  const CancelScope scope(stop_);
  try {
    setUpThenCycle();
  } catch (const Cancelled&) {
    // The nodelet is being unloaded.
  }
  // Threads end in the reverse order of their start. If the nodelet is loaded again, each thread then gets the heap of
  // its predecessor and reuses the memory freed there.
  listener_.reset();
}

void CollisionMonitor::setUpThenCycle() {
  try {
    setUp();
  } catch (const std::exception& error) {
    NODELET_FATAL("The monitor cannot start, so nothing is checked: %s", error.what());
    health_watch_.health().failure = error.what();
  }
  const std::string& failure = health_watch_.health().failure;
  TriggerOptions trigger = parameters_.trigger;
  if (!failure.empty()) trigger = {TriggerKind::kTimer, {}, kIdlePeriod, 0.0};
  trigger_.setOptions(trigger);
  pthread_setname_np(pthread_self(), "sdf_ccd cycles");  // only now: threads that it has started keep their names
  while (trigger_.wait([this] { attempt([this] { betweenCycles(); }); }) && ros::ok()) {
    std::string problem = failure;
    if (problem.empty()) problem = attempt([this] { cycle(); });
    if (!problem.empty()) attempt([&] { reportIdle(problem); });
  }
}

/// An exception that escaped from the monitor's thread would end the process, with all other nodelets in it.
/// @return the error message; empty if there was no exception.
std::string CollisionMonitor::attempt(const std::function<void()>& work) const {
  try {
    work();
  } catch (const std::exception& error) {
    NODELET_ERROR_THROTTLE(1.0, "A cycle was not checked: %s", error.what());
    return error.what();
  }
  return {};
}

void CollisionMonitor::waitForParameters() {
  for (;;) {
    try {
      parameters_ = readParameters(getPrivateNodeHandle());
      parameters_.scene.is_shared = true;
      return;
    } catch (const MissingDescription& missing) {
      NODELET_WARN_ONCE("Waiting: %s", missing.what());
      reportIdle(std::string("waiting: ") + missing.what());
    }
    if (!trigger_.waitFor(kIdlePeriod) || !ros::ok()) throw Cancelled();
  }
}

void CollisionMonitor::setUp() {
  reportIdle("reading the robot description");
  waitForParameters();
  if (const std::vector<std::string>& unused = parameters_.unused; !unused.empty())
    NODELET_WARN("Parameters that nothing reads: %s", firstOf(unused, unused.size(), "; ").c_str());
  const std::string directory = std::filesystem::path(parameters_.urdf_file).parent_path().string();
  described_ = describeScene(
      parameters_, [&](const std::string& uri) { return loadLocalResource(uri, ros::package::getPath, directory); });
  shareMeshes(described_.scene.bodies);
  setForces(parameters_.wrenches == MonitorParameters::Wrenches::kNever ? Forces::kUnwanted : Forces::kAwaited,
            described_.scene.bodies);
  for (const std::string& warning : described_.warnings) NODELET_WARN("%s", warning.c_str());
  buildScene();
  loop_ = std::make_unique<MonitorLoop>(first_world_, described_, parameters_);
  proximity_ = std::make_unique<ProximityOutputs>(getPrivateNodeHandle(), parameters_.proximity, *loop_);
  outputs_ = std::make_unique<Outputs>(getPrivateNodeHandle(), state_publisher_, world_publisher_, *loop_, described_,
                                       parameters_.markers, *proximity_);
  watchdog_ = std::make_unique<CycleWatchdog>(CycleWatchdog::Seconds(parameters_.tf.max_latency),
                                              [this](CycleWatchdog::Seconds elapsed) { reportLongCycle(elapsed); });
  listener_ = std::make_unique<TransformListener>(getNodeHandle(), *described_.robot, loop_->history(), trigger_);
  queries_ = std::make_unique<Queries>(first_world_, described_, parameters_, loop_->history());
  queries_->setMarkerPublisher(getPrivateNodeHandle().advertise<visualization_msgs::MarkerArray>("planned", 2));
  const auto wake = [this] { trigger_.wake(); };
  scene_editor_ = std::make_unique<SceneEditor>(std::move(world_editor_), described_, parameters_,
                                                SceneEditor::Parts{*loop_, *outputs_, *queries_}, wake,
                                                [this](const CheckedWorld& world) { publishPlan(world); });
  first_world_.reset();
  if (!parameters_.live_map.topic.empty()) {
    plan_->limitRate(
        services_->node(), [this] { return scene_editor_->world(); }, described_.fixed_frame);
    live_map_ = std::make_unique<LiveMap>(getNodeHandle(), parameters_, *scene_editor_, loop_->history(),
                                          LiveMap::Place{described_.root_frame, loop_->warnings()}, stop_);
  }
  warnAboutMapDistances();
  reconfiguration_ = std::make_unique<Reconfiguration>(services_->node(), parameters_, wake);
  health_watch_.health().building.clear();
  restart("waiting for transforms");
  services_->setReady(*queries_, *scene_editor_, described_.fixed_frame, parameters_.requests.reset);
  followWithForces();
}

/// Surfaces, on which verdicts depend, and what a live map needs; fields and shells of bodies with meshes follow.
void CollisionMonitor::buildScene() {
  const ros::WallTime start = ros::WallTime::now();
  const ScenePlan plan = planScene(described_.scene, planOptions(parameters_.scene));
  const std::shared_ptr<const Scene> scene =
      buildDescribed(described_, plan, parameters_.scene, [this](const std::string& body, double share) {
        checkCancelled();
        const std::string progress =
            "building surfaces: " + std::to_string(static_cast<int>(100.0 * share)) + " %, " + body;
        reportIdle(progress);
        logProgress(progress);
      });
  checkCancelled();
  world_editor_ = std::make_unique<WorldEditor>(parameters_.scene);
  first_world_ = std::make_shared<const CheckedWorld>(world_editor_->begin(described_.scene, plan, *scene));
  health_watch_.recordScene(*scene, described_, parameters_);
  publishPlan(*first_world_);
  NODELET_INFO("Ready after %.1f s, fixed frame %s. The plan:\n%s", (ros::WallTime::now() - start).toSec(),
               described_.fixed_frame.c_str(), planTable(*scene).c_str());
}

void CollisionMonitor::followWithForces() {
  if (parameters_.wrenches == MonitorParameters::Wrenches::kNever) return;
  const bool at_once = parameters_.wrenches == MonitorParameters::Wrenches::kAlways;
  force_builder_ = std::make_unique<ForceBuilder>(
      *scene_editor_, loop_->history(), [this, at_once] { return at_once || outputs_->haveWantedWrenches(); });
}

void CollisionMonitor::logProgress(const std::string& progress) {
  const ros::WallTime now = ros::WallTime::now();  // a simulated clock may not run yet
  if (!last_log_.isZero() && (now - last_log_).toSec() < kLogPeriod) return;
  last_log_ = now;
  NODELET_INFO("%s", progress.c_str());
}

/// Adopts a prepared world and new parameters at once.
void CollisionMonitor::betweenCycles() {
  if (scene_editor_) scene_editor_->adopt();
  if (!reconfiguration_ || !reconfiguration_->apply(parameters_)) return;
  trigger_.setOptions(parameters_.trigger);
  proximity_->setParameters(parameters_.proximity);
  outputs_->markers().setOptions(parameters_.markers);
  warnAboutMapDistances();
  health_watch_.health().wanted_rate = parameters_.rate;
}

void CollisionMonitor::warnAboutMapDistances() {
  const LiveMapParameters& map = parameters_.live_map;
  loop_->warnings().set("distances to the map",
                        map.topic.empty() ? "" : distancesWithinPadding(parameters_.proximity.thresholds, map.padding));
}

void CollisionMonitor::cycle() {
  const CycleWatchdog::Cycle watched(*watchdog_);
  diagnostics_->tick();
  if (services_->consumeReset()) {
    loop_->reset();
    if (live_map_) live_map_->forget();
    restart("reset");
  }
  listener_->recoverStatic();
  CycleRequest request = outputs_->request(parameters_.max_points);
  request.contacts |= parameters_.log_contacts;
  request.max_time = cycleTimeLimit(parameters_);
  const TfTracker::Step step = loop_->step(ros::Time::now(), request);
  if (step == TfTracker::Step::kCycle) return publishCycle();
  listener_->report(health_watch_.health());
  if (step == TfTracker::Step::kJump) {
    NODELET_WARN("Time has jumped: contacts and distances are discarded, and cycles start again");
    return restart("time has jumped");
  }
  if (step == TfTracker::Step::kWaiting && !isSilent()) return diagnostics_->update(health_watch_.health());
  const bool lacks_clock = ros::Time::isSimTime() && ros::Time::now().isZero();
  const std::string reason =
      lacks_clock ? "use_sim_time is true, but no message arrives on /clock" : "no new transforms";
  health_watch_.recordStall(*loop_, reason);
  reportIdle(reason);
}

/// Whether no cycle has run for max_latency, on the wall clock: a simulated clock that stands still cannot tell.
bool CollisionMonitor::isSilent() const {
  return (ros::WallTime::now() - last_step_).toSec() > parameters_.tf.max_latency;
}

/// Called by the watchdog's thread while the thread of the cycles works.
void CollisionMonitor::reportLongCycle(CycleWatchdog::Seconds elapsed) const {
  const std::string reason = "a cycle has been running for " + numberText(elapsed.count()) + " s";
  const boost::shared_ptr<MonitorState> state = uncheckedState(reason);
  proximity_->publishStop(*state);
  state_publisher_.publish(state);
  NODELET_WARN_THROTTLE(1.0, "Not checked: %s", reason.c_str());  // last: a console that nobody reads may block
}

void CollisionMonitor::publishCycle() {
  last_step_ = ros::WallTime::now();
  last_idle_ = ros::WallTime();
  const boost::shared_ptr<MonitorState> state = state_messages_.acquire();
  const ros::Time sent = ros::Time::now();
  loop_->watchFixedFrame();
  setMonitorState(*loop_, sent, *state);
  state->map_voxels_unproven = live_map_ ? static_cast<std::uint32_t>(live_map_->unproven()) : 0;
  outputs_->publish(state, proximity_->measure(*state));
  logContacts();
  listener_->report(health_watch_.health());
  health_watch_.recordCycle(*loop_, *state, proximity_->safety(), sent);
  health_watch_.recordTrigger(trigger_.awaitedFrame());
  diagnostics_->update(health_watch_.health());
}

void CollisionMonitor::logContacts() {
  if (!parameters_.log_contacts || loop_->contacts().size() == 0) return;
  for (const std::string& line : contact_log_.update(loop_->contacts(), ros::WallTime::now()))
    NODELET_WARN("%s", line.c_str());
}

/// Publishes the world while fields are built; later, Outputs does. Drawing large maps takes a while, so it waits for a
/// subscriber.
void CollisionMonitor::publishWorld() {
  if (loop_ || is_world_drawn_ || world_publisher_.getNumSubscribers() == 0 || described_.fixed_frame.empty()) return;
  world_publisher_.publish(toWorldMarkers(described_.scene));
  is_world_drawn_ = true;
}

void CollisionMonitor::reportIdle(const std::string& reason) {
  publishWorld();
  services_->setWaiting(reason);
  MonitorHealth& health = health_watch_.health();
  if (!loop_ && health.failure.empty()) health.building = reason;
  const ros::WallTime now = ros::WallTime::now();
  if (!last_idle_.isZero() && (now - last_idle_).toSec() < kIdlePeriod) return;
  publishUnchecked(reason);
  diagnostics_->update(health_watch_.health(), true);
}

void CollisionMonitor::publishUnchecked(const std::string& reason) {
  last_idle_ = ros::WallTime::now();
  const boost::shared_ptr<MonitorState> state = uncheckedState(reason);
  if (proximity_) proximity_->publishUnchecked(*state);
  outputs_ ? outputs_->publishUnchecked(reason, state) : state_publisher_.publish(state);
}

/// May be called while the thread of the cycles works.
boost::shared_ptr<MonitorState> CollisionMonitor::uncheckedState(const std::string& reason) const {
  const std::shared_ptr<const CheckedWorld> world = queries_ ? queries_->world() : nullptr;
  const auto state =
      boost::make_shared<MonitorState>(toUncheckedState(world ? world->version() : 0, described_.fixed_frame, reason,
                                                        ros::Time::now(), loop_ ? &loop_->warnings() : nullptr));
  if (world) state->pairs_allowed_by_requests = static_cast<std::uint32_t>(world->allowed_by_requests);
  return state;
}

void CollisionMonitor::restart(const std::string& reason) {
  if (outputs_) outputs_->markers().drawWorldAgain();  // rviz deletes all markers when time jumps
  health_watch_.restart();
  last_step_ = ros::WallTime::now();
  publishUnchecked(reason);
  diagnostics_->update(health_watch_.health(), true);
}

}  // namespace sdf_ccd

PLUGINLIB_EXPORT_CLASS(sdf_ccd::CollisionMonitor, nodelet::Nodelet)
