#include "ros/monitor/collision_monitor_nodelet.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>

#include <ros/package.h>
#include <pluginlib/class_list_macros.hpp>

#include "body/geometry_keys.h"
#include "monitor/over_budget.h"
#include "ros/messages/world_markers.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/plan_message.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

constexpr double kIdlePeriod = 1.0;    // [s]
constexpr double kLogPeriod = 3.0;     // of building's progress [s]
constexpr double kLateShown = 3.0;     // a contradiction by late transforms, in the diagnostics [s]
constexpr double kSending = 0.05;      // until the last messages have left [s]
constexpr double kPatience = 2.0;      // until it is warned of what is not checked [s]
constexpr double kWarnPeriod = 10.0;   // of such warnings [s]
constexpr double kPlanPeriod = 1.0;    // of plans, at most, with a live map [s]
constexpr double kStaticPeriod = 2.0;  // at most as often static transforms are asked for again [s]

/// What a thread has freed, glibc keeps for the heap of that thread: of threads that build and end, for nothing.
void returnFreedMemory() {
  malloc_trim(0);
}

}  // namespace

CollisionMonitor::~CollisionMonitor() {
  stop_ = true;
  trigger_.stop();
  if (thread_.joinable()) thread_.join();
  if (ros::ok()) {
    if (loop_) loop_->reset();
    publishUnchecked("the monitor has ended");
    if (outputs_) outputs_->finish();
    ros::WallDuration(kSending).sleep();
  }
  service_queue_.disable();  // the spinner wakes up at once
  if (service_spinner_) service_spinner_->stop();
  reconfiguration_.reset();
  live_map_.reset();
  scene_editor_.reset();
  queries_.reset();
  outputs_.reset();
  proximity_.reset();
  loop_.reset();
  first_world_.reset();
  world_editor_.reset();
  described_ = {};
  returnFreedMemory();
}

void CollisionMonitor::onInit() {
  ros::NodeHandle& private_node = getPrivateNodeHandle();
  state_publisher_ = private_node.advertise<MonitorState>("state", 100, true);
  plan_publisher_ = private_node.advertise<Plan>("plan", 1, true);
  world_publisher_ = private_node.advertise<visualization_msgs::MarkerArray>("world", 1, true);
  diagnostics_ = std::make_unique<Diagnostics>(getNodeHandle(), private_node, getName());
  serve();
  thread_ = std::thread([this] { run(); });
}

void CollisionMonitor::serve() {
  ros::NodeHandle node(getPrivateNodeHandle());
  node.setCallbackQueue(&service_queue_);
  services_ = {node.advertiseService("query_motion", &CollisionMonitor::queryMotion, this),
               node.advertiseService("query_motions", &CollisionMonitor::queryMotions, this),
               node.advertiseService("query_points", &CollisionMonitor::queryPoints, this),
               node.advertiseService("update_scene", &CollisionMonitor::updateScene, this),
               node.advertiseService("get_plan", &CollisionMonitor::getPlan, this),
               node.advertiseService("reset", &CollisionMonitor::reset, this)};
  // One for each query and change that is answered or waits, and one that says that there are too many.
  service_spinner_ = std::make_unique<ros::AsyncSpinner>(QueryLimits().queries + 4, &service_queue_);
  service_spinner_->start();
}

void CollisionMonitor::run() {
  const CancelScope scope(stop_);
  try {
    setUpThenCycle();
  } catch (const Cancelled&) {
    // The nodelet is being unloaded.
  }
  // Threads end in the reverse order of their beginning: so each gets the heap of its predecessor when the nodelet is
  // loaded again, and what has been freed there is used again.
  tf_queue_.disable();
  if (tf_spinner_) tf_spinner_->stop();
}

void CollisionMonitor::setUpThenCycle() {
  try {
    setUp();
  } catch (const std::exception& error) {
    NODELET_FATAL("Nothing is checked: %s", error.what());
    health_.failure = error.what();
  }
  TriggerOptions trigger = parameters_.trigger;
  if (!health_.failure.empty()) trigger = {TriggerKind::kTimer, {}, kIdlePeriod, 0.0};
  trigger_.setOptions(trigger);
  while (trigger_.wait([this] { betweenCycles(); }) && ros::ok()) {
    try {
      health_.failure.empty() ? cycle() : idle(health_.failure);
    } catch (const std::exception& error) {
      NODELET_ERROR_THROTTLE(1.0, "A cycle was not checked: %s", error.what());
      idle(error.what());
    }
  }
}

void CollisionMonitor::readWhenThere() {
  for (;;) {
    try {
      parameters_ = readParameters(getPrivateNodeHandle());
      parameters_.scene.is_shared = true;
      return;
    } catch (const MissingDescription& missing) {
      NODELET_WARN_ONCE("Waiting: %s", missing.what());
      idle(std::string("waiting: ") + missing.what());
    }
    if (!trigger_.waitFor(kIdlePeriod) || !ros::ok()) throw Cancelled();
  }
}

void CollisionMonitor::setUp() {
  idle("reading the robot");
  readWhenThere();
  for (const std::string& name : parameters_.unknown) NODELET_WARN("Nothing reads parameter %s", name.c_str());
  described_ = describeScene(parameters_, makeResourceLoader(ros::package::getPath, "", parameters_.allow_http));
  shareMeshes(described_.scene.bodies);
  for (const std::string& warning : described_.warnings) NODELET_WARN("%s", warning.c_str());
  joint_watch_ = std::make_unique<JointWatch>(*described_.robot);
  buildFields();
  loop_ = std::make_unique<MonitorLoop>(first_world_, described_, parameters_);
  proximity_ = std::make_unique<ProximityOutputs>(getPrivateNodeHandle(), parameters_.proximity);
  outputs_ = std::make_unique<Outputs>(getPrivateNodeHandle(), state_publisher_, world_publisher_, *loop_, described_,
                                       parameters_.markers, *proximity_);
  listen();
  returnFreedMemory();
  queries_ = std::make_unique<Queries>(first_world_, described_, parameters_, loop_->history());
  queries_->drawOn(getPrivateNodeHandle().advertise<visualization_msgs::MarkerArray>("planned", 2));
  const auto wake = [this] { trigger_.wake(); };
  scene_editor_ = std::make_unique<SceneEditor>(std::move(world_editor_), described_, parameters_,
                                                SceneEditor::Parts{*loop_, *outputs_, *queries_}, wake,
                                                [this](const CheckedWorld& world) { publishPlan(world); });
  first_world_.reset();
  ros::NodeHandle served(getPrivateNodeHandle());
  served.setCallbackQueue(&service_queue_);
  plan_timer_ = served.createWallTimer(
      ros::WallDuration(kPlanPeriod), [this](const ros::WallTimerEvent&) { publishPlan(*queries_->world()); }, true,
      false);
  if (!parameters_.live_map.topic.empty())
    live_map_ = std::make_unique<LiveMap>(getNodeHandle(), parameters_, *scene_editor_, loop_->history(), stop_);
  reconfiguration_ = std::make_unique<Reconfiguration>(served, parameters_, wake);
  health_.building.clear();
  forget("waiting for transforms");
  const std::lock_guard<std::mutex> lock(ready_mutex_);
  ready_ = true;
}

void CollisionMonitor::buildFields() {
  const ros::WallTime start = ros::WallTime::now();
  const ScenePlan plan = affordablePlan(described_, parameters_.scene);
  NODELET_INFO("Expected: %s", summary(*plan.expected).c_str());
  const std::shared_ptr<const Scene> scene =
      buildDescribed(described_, plan, parameters_.scene, [this](const std::string& body, double share) {
        checkCancelled();
        const std::string progress =
            "building fields: " + std::to_string(static_cast<int>(100.0 * share)) + " %, " + body;
        idle(progress);
        logNowAndThen(progress);
      });
  checkCancelled();
  world_editor_ = std::make_unique<WorldEditor>(parameters_.scene);
  first_world_ = std::make_shared<const CheckedWorld>(world_editor_->begin(described_.scene, plan, *scene),
                                                      described_.unreachable);
  health_.warnings = described_.warnings;
  health_.bad_bodies = failedBodies(*scene);
  for (const std::string& body : health_.bad_bodies) NODELET_ERROR("Not checked: %s", body.c_str());
  for (const BodyReport& report : scene->reports) {
    for (const std::string& warning : report.warnings) {
      NODELET_WARN("%s: %s", report.name.c_str(), warning.c_str());
      health_.warnings.push_back(report.name + ": " + warning);
    }
  }
  for (const std::string& warning : scene->warnings) {
    NODELET_WARN("%s", warning.c_str());
    health_.warnings.push_back(warning);
  }
  const std::string over = overBudget(*scene);
  if (!over.empty()) {
    NODELET_WARN("%s", over.c_str());
    health_.warnings.push_back(over);
  }
  health_.wanted_rate = parameters_.rate;
  health_.is_timed = parameters_.trigger.kind == TriggerKind::kTimer;
  health_.max_error = parameters_.scene.max_error.value_or(0.0);
  health_.pairs = static_cast<int>(scene->pairs.size());
  health_.pairs_left_out = static_cast<int>(std::count_if(
      scene->left_out.begin(), scene->left_out.end(), [](const LeftOut& left_out) { return left_out.body_a >= 0; }));
  publishPlan(*first_world_);
  NODELET_INFO("Ready after %.1f s, fixed frame %s. The plan:\n%s", (ros::WallTime::now() - start).toSec(),
               described_.fixed_frame.c_str(), planTable(*scene).c_str());
}

void CollisionMonitor::publishPlan(const CheckedWorld& world) {
  const ros::WallTime now = ros::WallTime::now();
  {
    const std::lock_guard<std::mutex> lock(plan_mutex_);
    const ros::WallDuration wait = plan_published_ + ros::WallDuration(kPlanPeriod) - now;
    if (!parameters_.live_map.topic.empty() && !plan_published_.isZero() &&
        wait.toSec() > 0.0) {  // another one may come before that
      plan_timer_.stop();
      plan_timer_.setPeriod(wait);
      plan_timer_.start();
      return;
    }
    plan_published_ = now;
  }
  plan_publisher_.publish(boost::make_shared<Plan>(toPlan(world, described_.fixed_frame, ros::Time::now())));
}

void CollisionMonitor::logNowAndThen(const std::string& progress) {
  const ros::WallTime now = ros::WallTime::now();  // a simulated clock may not run yet
  if (!last_log_.isZero() && (now - last_log_).toSec() < kLogPeriod) return;
  last_log_ = now;
  NODELET_INFO("%s", progress.c_str());
}

ros::Subscriber CollisionMonitor::listenTo(const std::string& tf_topic, bool is_static) {
  ros::NodeHandle node(getNodeHandle());
  node.setCallbackQueue(&tf_queue_);
  const boost::function<void(const tf2_msgs::TFMessageConstPtr&)> add =
      [this, is_static](const tf2_msgs::TFMessageConstPtr& message) { take(*message, is_static); };
  return node.subscribe<tf2_msgs::TFMessage>(tf_topic, 1000, add, ros::VoidConstPtr(),
                                             ros::TransportHints().tcpNoDelay());
}

/// Whoever subscribes is sent all static transforms: among them those that had no room when no body needed them.
void CollisionMonitor::hearStaticAgain() {
  const ros::WallTime now = ros::WallTime::now();
  if ((now - last_static_).toSec() < kStaticPeriod || !loop_->history().takeMissedStatic()) return;
  last_static_ = now;
  tf_static_subscriber_ = listenTo("/tf_static", true);
}

void CollisionMonitor::listen() {
  tf_subscriber_ = listenTo("/tf", false);
  tf_static_subscriber_ = listenTo("/tf_static", true);
  ros::NodeHandle node(getNodeHandle());
  node.setCallbackQueue(&tf_queue_);
  const boost::function<void(const sensor_msgs::JointStateConstPtr&)> watch =
      [this](const sensor_msgs::JointStateConstPtr& joints) {
        joint_watch_->add(*joints);
        trigger_.onJointStates();
      };
  joint_subscriber_ = node.subscribe<sensor_msgs::JointState>("joint_states", 10, watch);
  tf_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &tf_queue_);
  tf_spinner_->start();
}

/// Whatever a message says, it must not end the manager and its other nodelets.
void CollisionMonitor::take(const tf2_msgs::TFMessage& message, bool is_static) {
  TfHistory& history = loop_->history();
  try {
    history.watchClock(ros::Time::now());
    history.add(message, is_static);
    if (!is_static) trigger_.onTransforms();
    for (std::size_t i = 0; i < message.transforms.size() && trigger_.wantsFrames(); ++i) {
      trigger_.onFrame(withoutLeadingSlash(message.transforms[i].child_frame_id));
    }
  } catch (const std::exception& error) {
    NODELET_WARN_THROTTLE(10.0, "Transforms are dropped: %s", error.what());
  }
}

/// Says in the log, now and then, what is wrong with transforms that are dropped.
void CollisionMonitor::sayWhatIsDropped() {
  const TfHistory& history = loop_->history();
  const long refused = history.refused(), not_kept = history.notKept();
  if (refused > health_.refused) {
    NODELET_WARN_THROTTLE(10.0, "%ld transforms are refused so far, the last as %s", refused,
                          history.refusal().c_str());
  }
  if (not_kept > health_.not_kept) {
    NODELET_WARN_THROTTLE(10.0, "There are more frames than are kept: %ld transforms that no body needs are dropped",
                          not_kept);
  }
  health_.refused = refused;
  health_.not_kept = not_kept;
}

/// A world that is ready meanwhile, and parameters that were set, are taken over at once.
void CollisionMonitor::betweenCycles() {
  if (scene_editor_) scene_editor_->adopt();
  if (!reconfiguration_ || !reconfiguration_->apply(parameters_)) return;
  trigger_.setOptions(parameters_.trigger);
  proximity_->setParameters(parameters_.proximity);
  outputs_->setMarkers(parameters_.markers);
  health_.wanted_rate = parameters_.rate;
}

void CollisionMonitor::cycle() {
  diagnostics_->tick();
  if (reset_asked_.exchange(false)) {
    loop_->reset();
    forget("reset");
  }
  sayWhatIsDropped();
  hearStaticAgain();
  CycleRequest request = outputs_->request(parameters_.max_points);
  request.max_time = parameters_.max_cycle_time;
  request.refine = parameters_.refine;
  switch (loop_->step(ros::Time::now(), request)) {
    case TfTracker::Step::kWaiting:
      if (!isSilent()) return diagnostics_->update(health_);
      [[fallthrough]];
    case TfTracker::Step::kStalled:
      health_.stalled = true;
      health_.rate = 0.0;
      health_.bad_joints = joint_watch_->lines("joint_states");
      warnWhileUnchecked(true);
      return idle("no new transforms");
    case TfTracker::Step::kJump:
      NODELET_WARN("Time has jumped back: starting anew");
      return forget("time has jumped back");
    case TfTracker::Step::kCycle:
      break;
  }
  publishCycle();
}

/// A simulated clock that stands still does not tell that nothing comes.
bool CollisionMonitor::isSilent() const {
  return (ros::WallTime::now() - last_step_).toSec() > parameters_.tf.max_latency;
}

void CollisionMonitor::publishCycle() {
  const ros::WallTime now = ros::WallTime::now();
  if (!last_cycle_.isZero()) {
    const double rate = 1.0 / std::max(1e-6, (now - last_cycle_).toSec());
    health_.rate = health_.rate > 0.0 ? 0.9 * health_.rate + 0.1 * rate : rate;
  }
  last_cycle_ = last_step_ = now;
  last_idle_ = ros::WallTime();
  const boost::shared_ptr<MonitorState> state = state_messages_.take();
  const ros::Time sent = ros::Time::now();
  setMonitorState(*loop_, sent, *state);
  outputs_->publish(state, proximity_->measure(*loop_, sent, *state));
  health_.stalled = false;
  health_.world_version = loop_->world()->version();
  health_.latency = state->latency;
  health_.age = (sent - state->complete_until).toSec();
  health_.run_time = state->run_time;
  health_.error = loop_->result().error;
  health_.contact_error = loop_->result().contact_error;
  health_.missing = missingBodies(*loop_);
  health_.pairs_delayed = loop_->result().delayed;
  health_.pairs_postponed = loop_->result().postponed;
  health_.short_cycles += health_.pairs_postponed > 0;
  health_.contradicted = contradicted();
  health_.out_of_order = loop_->history().outOfOrder();
  health_.bad_joints = joint_watch_->lines("joint_states");
  warnOfMovingFrame();
  warnWhileUnchecked(!health_.missing.empty());
  diagnostics_->update(health_);
}

/// Once a second is often enough.
void CollisionMonitor::warnOfMovingFrame() {
  const ros::WallTime now = ros::WallTime::now();
  if ((now - last_frame_check_).toSec() < kIdlePeriod) return;
  last_frame_check_ = now;
  const std::string warning = loop_->movingFixedFrame();
  if (!warning.empty() && health_.moving_frame.empty()) NODELET_WARN("%s", warning.c_str());
  // It says so from then on: also while the robot rests.
  if (!warning.empty()) health_.moving_frame = warning;
}

/// Says on the console, now and then, why bodies are not checked.
void CollisionMonitor::warnWhileUnchecked(bool is_unchecked) {
  const ros::WallTime now = ros::WallTime::now();  // a simulated clock may not run
  if (!is_unchecked) {
    unchecked_since_ = ros::WallTime();
    return;
  }
  if (unchecked_since_.isZero()) unchecked_since_ = now;
  if ((now - unchecked_since_).toSec() < kPatience) return;
  if (!last_warning_.isZero() && (now - last_warning_).toSec() < kWarnPeriod) return;
  last_warning_ = now;
  std::string cause = uncheckedCause(*loop_);
  for (const std::string& line : health_.bad_joints) cause += "; " + line;
  NODELET_WARN("Not checked: %s", cause.c_str());
}

/// What late transforms have contradicted in the last seconds; said in the log when it begins.
std::string CollisionMonitor::contradicted() {
  const ros::WallTime now = ros::WallTime::now();
  const std::vector<LateTransforms>& late = loop_->cycle().late;
  if (!late.empty()) {
    last_late_ = now;
    late_ = late.front().frame + (late.size() > 1 ? " and others" : "") +
            " came late behind newer ones: what was said of the time since then is checked again";
    NODELET_WARN_THROTTLE(10.0, "Transforms of %s", late_.c_str());
  }
  const bool is_old = last_late_.isZero() || (now - last_late_).toSec() > kLateShown;
  return is_old ? "" : late_;
}

/// While it is built; then Outputs does. Large maps take a while to be drawn: not before somebody looks at them.
void CollisionMonitor::publishWorld() {
  if (loop_ || is_world_drawn_ || world_publisher_.getNumSubscribers() == 0 || described_.fixed_frame.empty()) return;
  world_publisher_.publish(toWorldMarkers(described_.scene));
  is_world_drawn_ = true;
}

void CollisionMonitor::idle(const std::string& reason) {
  publishWorld();
  {
    const std::lock_guard<std::mutex> lock(ready_mutex_);
    not_ready_ = reason;
  }
  if (!loop_ && health_.failure.empty()) health_.building = reason;
  const ros::WallTime now = ros::WallTime::now();
  if (!last_idle_.isZero() && (now - last_idle_).toSec() < kIdlePeriod) return;
  publishUnchecked(reason);
  diagnostics_->update(health_, true);
}

void CollisionMonitor::publishUnchecked(const std::string& reason) {
  last_idle_ = ros::WallTime::now();
  const auto state =
      boost::make_shared<MonitorState>(toUncheckedState(described_.fixed_frame, reason, ros::Time::now()));
  if (proximity_) proximity_->publishUnchecked(*state);
  outputs_ ? outputs_->publishUnchecked(reason, state) : state_publisher_.publish(state);
}

void CollisionMonitor::forget(const std::string& reason) {
  if (outputs_) outputs_->drawWorldAgain();  // rviz drops what it shows when time jumps back
  health_.missing.clear();
  last_cycle_ = ros::WallTime();
  last_step_ = ros::WallTime::now();
  publishUnchecked(reason);
  diagnostics_->update(health_, true);
}

bool CollisionMonitor::isReady(std::string& why_not) {
  const std::lock_guard<std::mutex> lock(ready_mutex_);
  if (!ready_) why_not = "not ready: " + not_ready_;
  return ready_;
}

bool CollisionMonitor::queryMotion(QueryMotion::Request& request, QueryMotion::Response& response) {
  answer(request, response);
  if (!response.success) response.verdict = QueryMotion::Response::NOT_CHECKED;
  return true;
}

bool CollisionMonitor::queryMotions(QueryMotions::Request& request, QueryMotions::Response& response) {
  answer(request, response);
  return true;
}

bool CollisionMonitor::queryPoints(QueryPoints::Request& request, QueryPoints::Response& response) {
  answer(request, response);
  return true;
}

template <class Request, class Response>
void CollisionMonitor::answer(const Request& request, Response& response) {
  if (!isReady(response.message)) return;
  const CancelScope scope(stop_);
  try {
    queries_->answer(request, response);
  } catch (const Cancelled&) {
    response = {};
    response.message = "the monitor ends";
  }
}

bool CollisionMonitor::updateScene(UpdateScene::Request& request, UpdateScene::Response& response) {
  response.failed_change = -1;
  if (!isReady(response.message)) return true;
  const CancelScope scope(stop_);
  try {
    scene_editor_->update(request, response);
  } catch (const Cancelled&) {
    response = {};
    response.failed_change = -1;
    response.message = "the monitor ends";
  }
  return true;
}

bool CollisionMonitor::getPlan(GetPlan::Request&, GetPlan::Response& response) {
  if (!isReady(response.message)) return true;
  response.plan = toPlan(*queries_->world(), described_.fixed_frame, ros::Time::now());
  response.success = true;
  return true;
}

bool CollisionMonitor::reset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  reset_asked_ = true;
  return true;
}

}  // namespace sdf_ccd

PLUGINLIB_EXPORT_CLASS(sdf_ccd::CollisionMonitor, nodelet::Nodelet)
