#include "ros/tf/tf_tracker.h"

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "common/number_text.h"
#include "motion/motion_sampling.h"
#include "motion/valid_pose.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

constexpr double kJumpAhead = 2e9;      // longer differences may not fit a ros::Duration [s]
constexpr double kRewindPerTime = 4.0;  // time that may be checked again, per time checked

std::vector<std::string> framesOf(const std::vector<TrackedBody>& bodies) {
  std::vector<std::string> frames;
  for (const TrackedBody& body : bodies) frames.push_back(withoutLeadingSlash(body.frame));
  return frames;
}

std::vector<BoundingBall> ballsOf(const std::vector<TrackedBody>& bodies) {
  std::vector<BoundingBall> balls;
  for (const TrackedBody& body : bodies) balls.push_back(body.ball_B);
  return balls;
}

MotionSampling samplingOf(const TfTrackerOptions& options, std::size_t max_poses) {
  MotionSampling sampling = options.sampling;
  sampling.max_poses = max_poses;
  return sampling;
}

/// The body of the least end that is not TIME_MAX; none if there is no such body.
std::optional<std::size_t> earliestOf(const std::vector<ros::Time>& ends) {
  const auto earliest = std::min_element(ends.begin(), ends.end());
  if (earliest == ends.end() || *earliest == ros::TIME_MAX) return std::nullopt;
  return static_cast<std::size_t>(earliest - ends.begin());
}

}  // namespace

std::string tooFar(const std::string& frame) {
  return fmt::format("{} is more than {:.0g} m from the origin", frame, kFarthestPose);
}

std::vector<TrackedBody> trackedBodies(const Scene& scene) {
  std::vector<TrackedBody> bodies;
  for (const Body& body : scene.bodies) bodies.push_back({body.frame, body.X_frame_B, body.ball});
  return bodies;
}

TfTracker::TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const std::vector<PlannedPair>& pairs,
                     const TfTrackerOptions& options, const std::vector<PlannedPair>& watched)
    : history_(history),
      bodies_(bodies),
      frames_(framesOf(bodies)),
      pairs_(pairs),
      checked_pairs_(pairs.size()),
      options_(options),
      sampler_(ballsOf(bodies), samplingOf(options, kMaxPoses)),
      chains_(frames_),
      is_checked_(bodies.size(), 0) {
  for (const TrackedBody& body : bodies_) {
    distances_.push_back((body.X_frame_B * body.ball_B.center).norm() + body.ball_B.radius);
  }
  moving_.reserve(bodies_.size());
  static_.reserve(bodies_.size());
  for (const PlannedPair& pair : pairs) is_checked_[pair.body_a] = is_checked_[pair.body_b] = 1;
  is_paired_ = is_checked_;
  for (const PlannedPair& pair : watched) is_paired_[pair.body_a] = is_paired_[pair.body_b] = 1;
  pairs_.insert(pairs_.end(), watched.begin(), watched.end());
  times_.assign(pairs_.size(), {});
  reset();
}

void TfTracker::reset() {
  last_end_ = ros::Time();
  first_ = ros::Time();
  waits_since_ = ros::Time();
  versions_.assign(bodies_.size(), 0);
  changed_.assign(bodies_.size(), ros::Time());
  added_.assign(bodies_.size(), ros::Time());
  was_known_.assign(bodies_.size(), 0);
  are_together_ = false;
  late_.clear();
  too_late_.assign(bodies_.size(), "");
  rewind_budget_ = kRewindPerTime * options_.max_cycle;
  rewound_ = 0.0;
}

TfTracker::Step TfTracker::next(const ros::Time& now, TrackedCycle& cycle) {
  history_.watchClock(now);
  const bool is_first = last_end_.isZero();
  std::vector<std::string>& missing = cycle.motion.missing;
  missing.assign(bodies_.size(), "");
  readHistory(now, missing);
  const ros::Time end = is_first ? ros::Time() : latestEnd(missing);
  const double ahead = is_first ? 0.0 : secondsBetween(last_end_, end);
  // The clock has gone back, or all frames have started over far in the past; or the clock was set far ahead.
  if (history_.takeJump() || -ahead > kJumpBack || ahead > kJumpAhead) {
    reset();
    noteFirst();
    return Step::kJump;
  }
  if (is_first) noteFirst();
  if (waits_since_.isZero()) waits_since_ = now;
  const bool waited_enough = secondsBetween(waits_since_, now) > options_.max_latency;
  if (is_first ? !begin(waited_enough, missing) : end <= last_end_ && !canCatchUp(missing))
    return waited_enough ? Step::kStalled : Step::kWaiting;
  waits_since_ = now;
  if (is_first) return Step::kWaiting;

  rewind_budget_ += kRewindPerTime * std::max(ahead, 0.0) - rewound_;
  rewind_budget_ = std::min(rewind_budget_, kRewindPerTime * options_.max_cycle);
  rewound_ = 0.0;
  cycle.start = last_end_;
  cycle.end = last_end_ = std::max(last_end_, end);
  cycle.late.swap(late_);
  late_.clear();
  advancePairs(cycle);
  findMoving();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (hasChanged(body)) changed_[body] = cycle.end;
    versions_[body] = spans_[body].version;
    was_known_[body] = was_known_[body] || spans_[body].problem.empty();
    too_late_[body].clear();
  }
  try {
    sampleParts(cycle);
  } catch (const std::exception& error) {
    setMissing(error.what(), cycle);  // the pairs' times are then reported as not checked, and not lost
  }
  setSpans(cycle);
  return Step::kCycle;
}

void TfTracker::readHistory(const ros::Time& now, std::vector<std::string>& missing) {
  history_.takeSpans(chains_, spans_);
  if (!last_end_.isZero()) {
    rewindNewPairs();
    rewindLatePairs();
  }
  ros::Time newest;
  for (const TfSpan& span : spans_) newest = std::max(newest, span.last);
  // Transforms may be stamped ahead of the clock, or come from a bag that is played without one.
  reference_ = now.isZero() || newest.isZero() ? std::max(now, newest) : std::min(now, newest);
  // With simulated time a bag may bring stamps older than the clock; otherwise the wall clock tells their age.
  const ros::Time& clock = ros::Time::isSimTime() ? reference_ : now;
  ends_.assign(bodies_.size(), ros::TIME_MAX);
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const TfSpan& span = spans_[body];
    if (!span.problem.empty()) {
      missing[body] = span.problem;
    } else if (!span.is_static && secondsBetween(span.last, clock) > options_.max_latency) {
      missing[body] = frames_[body] + " is late by " + secondsText(secondsBetween(span.last, clock), 2);
    } else if (hasChanged(body)) {
      missing[body] = span.change;
    } else if (!too_late_[body].empty()) {
      missing[body] = too_late_[body];
    } else if (!span.is_static) {
      ends_[body] = std::min(span.last, reference_);
    }
  }
}

bool TfTracker::hasChanged(std::size_t body) const {
  return versions_[body] != 0 && versions_[body] != spans_[body].version;
}

/// Tells bodies that move, or may, from those at rest: static ones, and those whose frame is not known.
void TfTracker::findMoving() {
  moving_.clear();
  static_.clear();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const bool moves = !spans_[body].is_static && spans_[body].problem.empty();
    (moves ? moving_ : static_).push_back(body);
  }
}

/// Notes the time since when the first moving frame is known.
void TfTracker::noteFirst() {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const ros::Time& since = spans_[body].first;
    if (ends_[body] != ros::TIME_MAX) first_ = first_.isZero() ? since : std::min(first_, since);
  }
}

/// Begins the first cycle where all bodies are known or, after some time, all but those that are missing.
bool TfTracker::begin(bool waited_enough, const std::vector<std::string>& missing) {
  const std::optional<std::size_t> earliest = earliestOf(ends_);
  const ros::Time start = earliest ? ends_[*earliest] : reference_;
  for (std::size_t body = 0; body < bodies_.size() && !waited_enough; ++body) {
    if (!missing[body].empty() || spans_[body].first > start) return false;  // its transforms may still arrive
  }
  if (start.isZero()) return false;
  last_end_ = start;
  for (std::size_t body = 0; body < bodies_.size(); ++body) was_known_[body] = spans_[body].problem.empty();
  const ros::Time& since = first_.isZero() ? waits_since_ : first_;
  begin_ = since.isZero() ? start : std::min(since, start);
  times_.clear();
  for (const PlannedPair& pair : pairs_) {
    const ros::Time known = std::max({begin_, spans_[pair.body_a].first, spans_[pair.body_b].first});
    times_.push_back({begin_, std::min(known, start)});
  }
  are_together_ = false;
  return true;
}

ros::Time TfTracker::latestEnd(const std::vector<std::string>& missing) const {
  bool is_one = true;  // whether all checked bodies that move have the same end
  ros::Time latest;
  for (std::size_t body = 0; body < bodies_.size() && is_one; ++body) {
    if (!is_checked_[body]) continue;
    is_one = missing[body].empty() && (ends_[body] == ros::TIME_MAX || latest.isZero() || ends_[body] == latest);
    if (ends_[body] != ros::TIME_MAX) latest = ends_[body];
  }
  if (is_one) return latest.isZero() ? reference_ : latest;
  latest = ros::Time();
  for (std::size_t p = 0; p < checked_pairs_; ++p) {
    const ros::Time end = std::min(ends_[pairs_[p].body_a], ends_[pairs_[p].body_b]);
    if (isKnown(p, missing) && end != ros::TIME_MAX) latest = std::max(latest, end);
  }
  return latest.isZero() ? reference_ : latest;
}

bool TfTracker::isKnown(std::size_t pair, const std::vector<std::string>& missing) const {
  return missing[pairs_[pair].body_a].empty() && missing[pairs_[pair].body_b].empty();
}

/// How far a pair goes in a cycle that ends at `end`; if it is not known, that time is not checked.
ros::Time TfTracker::goesUntil(std::size_t pair, bool is_known, const ros::Time& end) const {
  if (!is_known) return end;
  return std::max(times_[pair].until, std::min({ends_[pairs_[pair].body_a], ends_[pairs_[pair].body_b], end}));
}

/// Whether more is known of a pair that is behind the last cycle's end, or that it is too late.
bool TfTracker::canCatchUp(const std::vector<std::string>& missing) const {
  if (are_together_) return false;
  for (std::size_t p = 0; p < checked_pairs_; ++p)
    if (times_[p].until < goesUntil(p, isKnown(p, missing), last_end_)) return true;
  return false;
}

/// Usually all pairs advance together, and their times need not be stored one by one.
bool TfTracker::canAdvanceTogether(const TrackedCycle& cycle) const {
  if (!are_together_) return false;
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (is_paired_[body] && (!cycle.motion.missing[body].empty() || ends_[body] < cycle.end)) return false;
  }
  return true;
}

/// Stores the times of each pair, if the pairs have advanced together so far.
void TfTracker::storePairTimes() {
  if (are_together_) times_.assign(pairs_.size(), together_);
  are_together_ = false;
}

void TfTracker::advancePairs(TrackedCycle& cycle) {
  const std::vector<std::string>& missing = cycle.motion.missing;
  cycle.origin = cycle.start;
  cycle.complete_until = cycle.end;
  cycle.delayed_since = ros::Time();
  if (canAdvanceTogether(cycle)) {
    together_ = {cycle.start, cycle.end};
    return;
  }
  storePairTimes();
  is_known_.resize(pairs_.size());
  bool are_together = true;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const bool is_known = isKnown(p, missing);
    const ros::Time from = times_[p].until, until = goesUntil(p, is_known, cycle.end);
    times_[p] = {from, until};
    is_known_[p] = is_known;
    are_together &= is_known && from == cycle.start && until == cycle.end;
    cycle.complete_until = std::min(cycle.complete_until, until);
    if (from == until) {
      if (until == cycle.end || p >= checked_pairs_) continue;  // done, while others catch up
      cycle.delayed_since = cycle.delayed_since.isZero() ? from : std::min(cycle.delayed_since, from);
      continue;
    }
    cycle.origin = std::min(cycle.origin, from);
  }
  are_together_ = are_together;
  together_ = {cycle.start, cycle.end};
}

void TfTracker::continueFrom(TfTracker& other, const std::vector<int>& bodies, const std::vector<int>& pairs) {
  begin_ = other.begin_;
  first_ = other.first_;
  last_end_ = other.last_end_;
  waits_since_ = other.waits_since_;
  rewind_budget_ = other.rewind_budget_;
  rewound_ = other.rewound_;
  late_.swap(other.late_);
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    added_[body] = last_end_;
    if (bodies[body] < 0) continue;
    const auto before = static_cast<std::size_t>(bodies[body]);
    added_[body] = other.added_[before];
    was_known_[body] = other.was_known_[before];
    versions_[body] = other.versions_[before];
    changed_[body] = other.changed_[before];
    too_late_[body].swap(other.too_late_[before]);
  }
  are_together_ = other.are_together_;
  together_ = other.together_;
  for (std::size_t p = 0; p < pairs.size() && !are_together_ && !other.times_.empty(); ++p)
    times_[p] = pairs[p] < 0 ? TimePart{last_end_, last_end_} : other.times_[static_cast<std::size_t>(pairs[p])];
}

void posesAt(const TfHistory& history, const std::vector<TrackedBody>& bodies, const ros::Time& time,
             std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) {
  struct Known {
    Isometry3d X_WF;
    std::string problem;
  };
  std::map<std::string, Known> known;  // by frame: thousands of tiles of a map have the same
  X_WB.assign(bodies.size(), Isometry3d::Identity());
  missing.resize(bodies.size());
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (!missing[body].empty()) continue;
    const std::string frame = withoutLeadingSlash(bodies[body].frame);
    const auto [found, is_new] = known.try_emplace(frame);
    Known& of_frame = found->second;
    if (is_new) history.lookup(frame, time, of_frame.X_WF, of_frame.problem);
    missing[body] = of_frame.problem;
    if (!missing[body].empty()) continue;
    X_WB[body] = of_frame.X_WF * bodies[body].X_frame_B;
    if (!isNearOrigin(X_WB[body].translation())) missing[body] = tooFar(frame);
  }
}

}  // namespace sdf_ccd
