#include "ros/monitor/health_watch.h"

#include <algorithm>

#include <ros/console.h>

#include "common/counted.h"
#include "common/number_text.h"
#include "monitor/over_budget.h"
#include "ros/monitor/unchecked.h"
#include "ros/tf/prefix_hint.h"
#include "ros/tf/seconds_between.h"
#include "scene/no_pairs.h"

namespace sdf_ccd {
namespace {

constexpr double kLateHold = 3.0;     // time for which late transforms are reported [s]
constexpr double kWarnDelay = 2.0;    // time before bodies that are not checked are logged [s]
constexpr double kWarnPeriod = 10.0;  // between such log messages [s]

/// Sets why the cycle's health is not kOk; empty if it is. Reuses the text's memory.
void setFinding(const CycleSafety& safety, const MonitorState& state, std::string& text) {
  text.clear();
  if (safety.health == Health::kOk) return;
  if (safety.finding == CycleFinding::kOld) {
    text = "the newest data of a pair are older than velocity_scale/max_age";
  } else if (!state.reason.empty()) {
    text = state.reason;
  } else {
    const bool is_error = safety.health == Health::kError;
    text += counted(is_error ? state.cycle.not_checked : state.cycle.delayed, "pair");  // short: allocates nothing
    text += is_error ? " could not be checked" : " wait for late transforms";
  }
}

}  // namespace

void HealthWatch::warn(const std::string& warning) {
  ROS_WARN("%s", warning.c_str());
  health_.warnings.push_back(warning);
}

void HealthWatch::recordScene(const Scene& scene, const DescribedScene& described,
                              const MonitorParameters& parameters) {
  health_.warnings = described.warnings;
  health_.bad_bodies = failedBodies(scene);
  for (const Body& body : scene.bodies) {
    if (body.failure.empty()) continue;
    const auto level =
        body.map.empty() ? ros::console::levels::Error : ros::console::levels::Warn;  // a map may still arrive
    ROS_LOG(level, ROSCONSOLE_DEFAULT_NAME, "Not checked: %s: %s", body.name.c_str(), body.failure.c_str());
  }
  for (const BodyReport& report : scene.reports)
    for (const std::string& warning : report.warnings) warn(report.name + ": " + warning);
  for (const std::string& warning : scene.warnings) warn(warning);  // watchStanding() tells the overlap_notes
  if (const std::string none = whyNoPairs(scene); !none.empty()) ROS_WARN("%s", none.c_str());  // may change
  const std::string over = overBudget(scene);
  if (!over.empty()) warn(over);
  health_.wanted_rate = parameters.rate;
  health_.is_timed = parameters.trigger.kind == TriggerKind::kTimer;
  health_.max_error = parameters.scene.max_error.value_or(0.0);
  countPairs(scene);
}

void HealthWatch::countPairs(const Scene& scene) {
  health_.pairs = static_cast<int>(scene.pairs.size());
  health_.pairs_left_out = static_cast<int>(scene.left_out.size());
}

void HealthWatch::recordCycle(const MonitorLoop& loop, const MonitorState& state, const CycleSafety& safety,
                              const ros::Time& sent) {
  const ros::WallTime now = ros::WallTime::now();
  const CycleResult& result = loop.result();
  measureRate(now);
  health_.stall.clear();
  if (health_.world_version != loop.world()->version()) {
    health_.world_version = loop.world()->version();
    health_.bad_bodies = failedBodies(loop.scene());
    countPairs(loop.scene());
  }
  health_.safety = safety.health;
  setFinding(safety, state, health_.finding);
  health_.latency = state.latency;
  health_.age = secondsBetween(state.cycle.complete_until, sent);
  health_.run_time = state.cycle.run_time;
  health_.error = result.error;
  health_.contact_error = result.contact_error;
  setMissingBodies(loop, health_.missing);
  health_.pairs_delayed = result.delayed;
  health_.pairs_postponed = result.postponed;
  health_.pairs_incomplete = result.incomplete;
  health_.short_cycles += result.postponed + result.incomplete > 0;
  watchStanding(loop.warnings());
  watchLate(loop, now);
  const std::string body = health_.missing.empty() ? "" : uncheckedCause(loop);
  watchUnchecked(loop, body, result.not_checked > 0 ? uncheckedPair(loop) : "");
}

void HealthWatch::recordTrigger(const std::string& awaited_frame) {
  const ros::WallTime now = ros::WallTime::now();
  if (awaited_frame.empty()) {
    awaited_since_ = ros::WallTime();
    awaited_frame_.clear();
    health_.trigger_warning.clear();
    return;
  }
  if (awaited_since_.isZero()) awaited_since_ = now;
  if ((now - awaited_since_).toSec() < kWarnDelay || awaited_frame == awaited_frame_) return;
  awaited_frame_ = awaited_frame;
  health_.trigger_warning =
      "trigger_frames: no transform of " + awaited_frame + " has been received, so cycles start without it";
  ROS_WARN("%s", health_.trigger_warning.c_str());
}

void HealthWatch::recordStall(const MonitorLoop& loop, const std::string& reason) {
  health_.stall = reason;
  health_.rate = 0.0;
  watchStanding(loop.warnings());
  watchUnchecked(loop, reason, uncheckedCause(loop));
}

void HealthWatch::restart() {
  health_.safety = MonitorHealth().safety;
  health_.finding = MonitorHealth().finding;
  health_.missing.clear();
  last_cycle_ = ros::WallTime();
}

void HealthWatch::watchStanding(const StandingWarnings& warnings) {
  warnings.copyTo(standing_);
  if (standing_ == health_.standing) return;
  for (const std::string& warning : standing_) {
    const std::vector<std::string>& known = health_.standing;
    if (std::find(known.begin(), known.end(), warning) == known.end()) ROS_WARN("%s", warning.c_str());
  }
  health_.standing = standing_;
}

void HealthWatch::measureRate(const ros::WallTime& now) {
  if (!last_cycle_.isZero()) {
    const double rate = 1.0 / std::max(1e-6, (now - last_cycle_).toSec());
    health_.rate = health_.rate > 0.0 ? 0.9 * health_.rate + 0.1 * rate : rate;
  }
  last_cycle_ = now;
}

void HealthWatch::watchUnchecked(const MonitorLoop& loop, const std::string& cause, const std::string& other) {
  const ros::WallTime now = ros::WallTime::now();  // a simulated clock may not run
  if (cause.empty() && other.empty()) {
    unchecked_since_ = ros::WallTime();
    return;
  }
  if (unchecked_since_.isZero()) unchecked_since_ = now;
  if ((now - unchecked_since_).toSec() < kWarnDelay) return;
  if (!last_warning_.isZero() && (now - last_warning_).toSec() < kWarnPeriod) return;
  last_warning_ = now;
  std::string all = cause;
  const auto add = [&](const std::string& line) { all += (all.empty() || line.empty() ? "" : "; ") + line; };
  add(other);
  std::vector<std::string> frames;
  for (const Body& body : loop.scene().bodies)
    if (!body.is_world) frames.push_back(body.frame);
  add(prefixHint(frames, loop.history().frames()));
  for (const std::string& line : health_.bad_joints) add(line);
  ROS_WARN("Not checked: %s", all.c_str());
}

/// Reports results that late transforms have contradicted in the last seconds.
void HealthWatch::watchLate(const MonitorLoop& loop, const ros::WallTime& now) {
  const std::vector<LateTransforms>& late = loop.cycle().late;
  if (!late.empty()) {
    last_late_ = now;
    health_.contradicted = "transforms of " + late.front().frame + (late.size() > 1 ? " and other frames" : "") +
                           " arrived after newer ones: results since their stamps are invalid, and are checked again";
    ROS_WARN_THROTTLE(10.0, "Late transforms: %s", health_.contradicted.c_str());
  } else if (!last_late_.isZero() && (now - last_late_).toSec() > kLateHold) {
    health_.contradicted.clear();
  }
}

}  // namespace sdf_ccd
