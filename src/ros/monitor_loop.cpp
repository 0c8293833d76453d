#include "ros/monitor_loop.h"

#include <algorithm>

#include "monitor/summarise.h"

namespace sdf_ccd {
namespace {

/// The frames of all bodies, and of all links: queries rest on these.
TfHistoryOptions historyOptions(const Scene& scene, const DescribedScene& described,
                                const MonitorParameters& parameters) {
  TfHistoryOptions options;
  options.wanted = {withoutLeadingSlash(described.fixed_frame)};
  for (const Body& body : scene.bodies) options.wanted.push_back(withoutLeadingSlash(body.frame));
  const std::vector<std::string> links = described.robot ? described.robot->links() : std::vector<std::string>();
  for (const std::string& link : links) {
    options.wanted.push_back(withoutLeadingSlash(described.tf_prefix + link));
  }
  // A cycle of max_cycle may have waited for max_latency; as long again for those that check it anew.
  options.keep = std::max(options.keep, 2.0 * (parameters.tf.max_cycle + parameters.tf.max_latency));
  return options;
}

}  // namespace

MonitorLoop::MonitorLoop(const std::shared_ptr<const Scene>& scene, const DescribedScene& described,
                         const MonitorParameters& parameters)
    : history_(described.fixed_frame, historyOptions(*scene, described, parameters)),
      tracker_(history_, trackedBodies(*scene), scene->pairs, parameters.tf),
      monitor_(scene, parameters.monitor),
      reach_guard_(described, monitor_.scene()),
      contacts_(monitor_.scene()),
      distances_(scene) {}

TfTracker::Step MonitorLoop::step(const ros::Time& now, const CycleRequest& request) {
  const TfTracker::Step step = tracker_.next(now, cycle_);
  contacts_.settle();
  if (step == TfTracker::Step::kJump) {
    monitor_.reset();
    contacts_.lose();
    distances_.forget();
  }
  if (step == TfTracker::Step::kCycle) {
    run(request);
    trackContacts(request);
  }
  return step;
}

void MonitorLoop::run(const CycleRequest& request) {
  try {
    result_ = &monitor_.run(cycle_.motion, request);
    guardReach();
  } catch (const std::exception& error) {
    monitor_.reset();
    cycle_.motion.missing.assign(scene().bodies.size(), error.what());
    cycle_.motion.motion_error.clear();
    result_ = &monitor_.run(cycle_.motion, request);
  }
}

void MonitorLoop::guardReach() {
  const std::vector<UncheckedPair> unchecked = reach_guard_.check(history_, cycle_);
  if (unchecked.empty()) return;
  guarded_ = *result_;
  addUnchecked(unchecked, guarded_);
  result_ = &guarded_;
}

void MonitorLoop::trackContacts(const CycleRequest& request) {
  if (!request.wantsContacts()) return contacts_.lose();
  contacts_.update({*result_, cycle_.motion, cycle_.samples, std::chrono::nanoseconds(cycle_.origin.toNSec())});
}

std::string MonitorLoop::movingFixedFrame() const {
  constexpr double kMoved = 0.02, kTurned = 0.02;  // more than what localisation makes of a robot that rests [m, rad]
  const std::string& fixed = history_.fixedFrame();
  const std::vector<Body>& bodies = scene().bodies;
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
    return "the fixed frame " + fixed + " moves in " + above + ", and objects of the world with it, as " +
           object->name + ": set fixed_frame to " + above + ", or to another frame that rests";
  }
  return {};
}

const std::vector<PairDistance>& MonitorLoop::measureDistances(double range) {
  return distances_.update(cycle_.motion, *result_, range);
}

void MonitorLoop::reset() {
  tracker_.reset();
  monitor_.reset();
  contacts_.settle();
  contacts_.lose();
  distances_.forget();
}

}  // namespace sdf_ccd
