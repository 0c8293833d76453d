#include "ros/monitor/monitor_loop.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "monitor/scene_difference.h"
#include "monitor/summarise.h"
#include "ros/monitor/unchecked.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

/// The frames of all bodies, and of all links, which queries need.
TfHistoryOptions historyOptions(const Scene& scene, const DescribedScene& described,
                                const MonitorParameters& parameters) {
  TfHistoryOptions options;
  options.wanted = {withoutLeadingSlash(described.fixed_frame)};
  for (const Body& body : scene.bodies) options.wanted.push_back(withoutLeadingSlash(body.frame));
  if (described.robot)
    for (std::string& frame : described.frames().all()) options.wanted.push_back(std::move(frame));
  // A cycle as long as max_cycle may have waited for max_latency. Twice that is kept, so that late transforms can have
  // it checked again for as long afterwards.
  options.keep = std::max(options.keep, 2.0 * (parameters.tf.max_cycle + parameters.tf.max_latency));
  return options;
}

/// Names of the bodies of the checked pairs, then of the watched ones.
std::vector<std::pair<std::string, std::string>> trackedNames(const Scene& scene, const RigidGuard& guard) {
  std::vector<std::pair<std::string, std::string>> names = pairNames(scene);
  for (const PlannedPair& pair : guard.pairs())
    names.emplace_back(scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name);
  return names;
}

/// All bodies at rest where they are now, as far as that is known.
CycleMotion presentPoses(const TfHistory& history, const std::vector<TrackedBody>& bodies) {
  std::vector<Isometry3d> X_WB;
  CycleMotion motion;
  posesAt(history, bodies, ros::Time(), X_WB, motion.missing);
  motion.times = {0.0, 1.0};
  for (const Isometry3d& X : X_WB) motion.X_WB.push_back({X});
  return motion;
}

/// Per body: the number of its pairs.
std::vector<std::uint32_t> pairsOf(const Scene& scene) {
  std::vector<std::uint32_t> pairs(scene.bodies.size(), 0);
  for (const PlannedPair& pair : scene.pairs)
    for (const int body : {pair.body_a, pair.body_b}) ++pairs[static_cast<std::size_t>(body)];
  return pairs;
}

}  // namespace

MonitorLoop::MonitorLoop(std::shared_ptr<const CheckedWorld> world, DescribedScene described,
                         const MonitorParameters& parameters)
    : world_(std::move(world)),
      described_(std::move(described)),
      tf_options_(parameters.tf),
      history_(described_.fixed_frame, historyOptions(world_->scene(), described_, parameters)),
      rigid_guard_(std::make_unique<RigidGuard>(world_->scene())),
      tracker_(std::make_unique<TfTracker>(history_, world_->bodies, world_->scene().pairs, tf_options_,
                                           rigid_guard_->pairs())),
      monitor_(world_->snapshot->scene, parameters.monitor),
      contacts_(monitor_.scene(), parameters.contact_join),
      distances_(std::make_unique<PairDistances>(world_->snapshot->scene)),
      traits_finder_(
          described_.robot, [this](const std::string& frame) { return described_.frames().linkOf(frame); },
          parameters.proximity.pairs),
      traits_(traits_finder_.of(world_->scene(), world_->description())),
      pairs_of_bodies_(pairsOf(monitor_.scene())) {
  OverlapNotes overlaps = overlapNotes(described_.overlaps, described_.overlap_rule, world_->scene());
  setOverlaps(overlaps);
}

MonitorLoop::MonitorLoop(const std::shared_ptr<const Scene>& scene, const DescribedScene& described,
                         const MonitorParameters& parameters)
    : MonitorLoop(firstWorld(scene, described.scene), described, parameters) {}

std::unique_ptr<LoopChange> MonitorLoop::prepare(std::shared_ptr<const CheckedWorld> next) {
  auto change = std::make_unique<LoopChange>();
  const Scene& scene = next->scene();
  std::set<std::string> frames;
  for (const BodyList* bodies : {&scene.bodies, &monitor_.scene().bodies})  // the cycles still need theirs
    for (const Body& body : *bodies) frames.insert(withoutLeadingSlash(body.frame));
  history_.setExtraFrames({frames.begin(), frames.end()});

  const CycleMotion present = presentPoses(history_, next->bodies);
  change->monitor = monitor_.prepare(next->snapshot->scene, &present);
  change->rigid_guard = std::make_unique<RigidGuard>(scene);
  change->tracker =
      std::make_unique<TfTracker>(history_, next->bodies, scene.pairs, tf_options_, change->rigid_guard->pairs());
  change->tracker->warmUp();
  // Also pairs of bodies that have changed continue: otherwise, if a body changes repeatedly, its pair with a body
  // whose frame lags behind would never be checked.
  change->pairs_before =
      findPairs(trackedNames(scene, *change->rigid_guard), trackedNames(world_->scene(), *rigid_guard_));
  change->contacts = contacts_.prepare(scene);
  change->distances = std::make_unique<PairDistances>(next->snapshot->scene);
  change->overlaps = overlapNotes(described_.overlaps, described_.overlap_rule, scene);
  change->traits = traits_finder_.of(scene, next->description());
  change->pairs_of_bodies = pairsOf(scene);
  constexpr std::size_t kPoses = 16;  // per body and cycle, usually fewer
  CycleMotion& motion = change->cycle.motion;
  motion.X_WB.resize(scene.bodies.size());
  for (std::vector<Isometry3d>& poses : motion.X_WB) poses.reserve(kPoses);
  motion.missing.resize(scene.bodies.size());
  motion.motion_error.reserve(scene.bodies.size());
  motion.spans.reserve(scene.pairs.size());
  change->cycle.watched.reserve(change->rigid_guard->pairs().size());
  change->cycle.gaps.reserve(scene.bodies.size());
  change->world = std::move(next);
  return change;
}

void MonitorLoop::adopt(LoopChange& change) {
  const SceneDifference& difference = change.monitor->difference();
  monitor_.adopt(*change.monitor);
  change.tracker->continueFrom(*tracker_, difference.bodiesBefore(), change.pairs_before);
  tracker_.swap(change.tracker);
  rigid_guard_.swap(change.rigid_guard);
  contacts_.adopt(*change.contacts);
  change.distances->continueFrom(*distances_, difference.pairsNow());
  distances_.swap(change.distances);
  setOverlaps(change.overlaps);
  traits_.swap(change.traits);
  pairs_of_bodies_.swap(change.pairs_of_bodies);
  std::swap(cycle_, change.cycle);
  cycle_.start = change.cycle.start;
  cycle_.end = change.cycle.end;
  cycle_.complete_until = change.cycle.complete_until;
  cycle_.delayed_since = change.cycle.delayed_since;
  world_.swap(change.world);
  result_ = nullptr;
}

TfTracker::Step MonitorLoop::step(const ros::Time& now, const CycleRequest& request) {
  const TfTracker::Step step = tracker_->next(now, cycle_);
  contacts_.clearEvents();
  if (step == TfTracker::Step::kJump) {
    monitor_.reset();
    contacts_.endAllAsLost();
    distances_->forget();
  }
  if (step == TfTracker::Step::kCycle) {
    addOutdatedMap(world_->map_age.get(), sinceEpoch(now), scene().bodies, cycle_.motion.missing);
    request_ = request;
    run(request);
    findUnchecked();
    trackContacts(request);
  }
  return step;
}

void MonitorLoop::run(const CycleRequest& request) {
  try {
    result_ = &monitor_.run(cycle_.motion, request);
    guardRigid();
  } catch (const std::exception& error) {
    monitor_.reset();
    cycle_.motion.missing.assign(scene().bodies.size(), error.what());
    cycle_.motion.motion_error.clear();
    result_ = &monitor_.run(cycle_.motion, request);
  }
}

void MonitorLoop::guardRigid() {
  if (cycle_.samples.empty()) return;
  const auto wasKnown = [this](int body, double time) {
    const TfSpan known = history_.span(withoutLeadingSlash(scene().bodies[body].frame));
    return known.problem.empty() && known.first <= cycle_.origin + ros::Duration(time);
  };
  const std::vector<UncheckedPair> unchecked = rigid_guard_->check(cycle_.motion, cycle_.watched, wasKnown);
  if (unchecked.empty()) return;
  guarded_ = *result_;
  addUnchecked(unchecked, guarded_);
  result_ = &guarded_;
}

void MonitorLoop::findUnchecked() {
  unchecked_since_.assign(scene().bodies.size(), ros::TIME_MAX);
  if (result_->not_checked == 0) return;
  for (const int i : result_->not_clear) {
    const PairResult& pair = result_->pairs[static_cast<std::size_t>(i)];
    if (pair.verdict != Verdict::kNotChecked) continue;
    const ros::Time since = cycle_.origin + ros::Duration(cycle_.motion.times[pair.span.first]);
    for (const int body : {pair.body_a, pair.body_b}) {
      ros::Time& earliest = unchecked_since_[static_cast<std::size_t>(body)];
      earliest = std::min(earliest, since);
    }
  }
}

void MonitorLoop::trackContacts(const CycleRequest& request) {
  if (!request.wantsContacts()) return contacts_.endAllAsLost();
  contacts_.update({*result_, cycle_.motion, cycle_.recorded, sinceEpoch(cycle_.origin)});
}

void MonitorLoop::setOverlaps(OverlapNotes& notes) {
  if (notes.set_aside != overlaps_.set_aside) warnings_.set("overlaps_set_aside", notes.set_aside);
  if (notes.checked != overlaps_.checked) warnings_.set("overlaps_checked", notes.checked);
  std::swap(overlaps_, notes);
}

void MonitorLoop::watchFixedFrame() {
  constexpr double kPeriod = 0.2;  // between two tests [s]
  const double elapsed = secondsBetween(frame_watched_, cycle_.end);
  if (0.0 <= elapsed && elapsed < kPeriod) return;
  frame_watched_ = cycle_.end;
  const std::string warning = movingFixedFrame();
  if (!warning.empty()) warnings_.set("fixed_frame", warning);
}

std::string MonitorLoop::movingFixedFrame() const {
  constexpr double kMoved = 0.02, kTurned = 0.02;  // more than localisation noise of a robot at rest [m, rad]
  const std::string& fixed = history_.fixedFrame();
  const BodyList& bodies = scene().bodies;
  const auto object = std::find_if(bodies.begin(), bodies.end(), [&](const Body& body) {
    return body.is_world && withoutLeadingSlash(body.frame) == fixed;
  });
  if (object == bodies.end()) return {};
  for (const std::string& above : history_.framesAbove(fixed)) {
    const TfSpan span = history_.span(above);
    Isometry3d X_then, X_now;
    std::string problem;
    if (!span.problem.empty() || span.is_static || !history_.lookup(above, span.first, X_then, problem) ||
        !history_.lookup(above, span.last, X_now, problem)) {
      continue;
    }
    const double turned = Quaterniond(X_then.linear()).angularDistance(Quaterniond(X_now.linear()));
    if (turned < kTurned && (X_now.inverse().translation() - X_then.inverse().translation()).norm() < kMoved) continue;
    return fmt::format(
        "the fixed frame {0} moves in {1}, and objects of the world move with it, such as {2}: set the parameter "
        "fixed_frame to {1} or another frame that does not move",
        fixed, above, object->name);
  }
  return {};
}

const std::vector<PairDistance>& MonitorLoop::measureDistances(double range) {
  return distances_->update(cycle_.motion, *result_, range, {sinceEpoch(cycle_.origin), &cycle_.gaps, true});
}

void MonitorLoop::reset() {
  history_.forgetMoving();
  tracker_->reset();
  monitor_.reset();
  contacts_.clearEvents();
  contacts_.endAllAsLost();
  distances_->forget();
}

}  // namespace sdf_ccd
