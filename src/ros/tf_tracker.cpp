#include "ros/tf_tracker.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace sdf_ccd {
namespace {

const ros::Duration kJumpBack(1.0);         // as of TfHistory
constexpr double kBackPerTime = 4.0;        // time checked again, over the time itself
constexpr std::size_t kMostPoses = 300000;  // of all bodies in a cycle: about 100 MB with what is made of them

std::string seconds(const ros::Duration& duration) {
  return fmt::format("{:.2f} s", duration.toSec());
}

bool isTooFar(const Isometry3d& X_WB) {
  return !(X_WB.translation().lpNorm<Eigen::Infinity>() <= kFarthestPose);
}

std::string tooFar(const std::string& frame) {
  return fmt::format("{} is more than {:.0g} m from the origin", frame, kFarthestPose);
}

/// Adds to those of the same frame.
void merge(const LateTransforms& late, std::vector<LateTransforms>& all) {
  const auto same =
      std::find_if(all.begin(), all.end(), [&](const LateTransforms& other) { return other.frame == late.frame; });
  if (same == all.end()) return all.push_back(late);
  same->since = std::min(same->since, late.since);
  same->until = std::max(same->until, late.until);
}

}  // namespace

std::vector<TrackedBody> trackedBodies(const Scene& scene) {
  std::vector<TrackedBody> bodies;
  for (const Body& body : scene.bodies) bodies.push_back({body.frame, body.X_frame_B, motionBall(body)});
  return bodies;
}

TfTracker::TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const std::vector<PlannedPair>& pairs,
                     const TfTrackerOptions& options)
    : history_(history), bodies_(bodies), pairs_(pairs), options_(options) {
  for (TrackedBody& body : bodies_) {
    body.frame = withoutLeadingSlash(body.frame);
    frames_.push_back(body.frame);
    balls_.push_back(body.ball_B);
  }
  reset();
}

void TfTracker::reset() {
  last_end_ = ros::Time();
  waits_since_ = ros::Time();
  versions_.assign(bodies_.size(), 0);
  changed_.assign(bodies_.size(), ros::Time());
  late_.clear();
  too_late_.assign(bodies_.size(), "");
  time_to_go_back_ = kBackPerTime * options_.max_cycle;
  goes_back_ = 0.0;
}

TfTracker::Step TfTracker::next(const ros::Time& now, TrackedCycle& cycle) {
  history_.watchClock(now);
  const bool is_first = last_end_.isZero();
  std::vector<std::string>& missing = cycle.motion.missing;
  missing.assign(bodies_.size(), "");
  look(now, missing);
  const ros::Time end = is_first ? ros::Time() : foremostEnd(missing);
  // The clock has gone back, or all frames have begun anew far behind.
  if (history_.takeJump() || (!is_first && end < last_end_ && last_end_ - end > kJumpBack)) {
    reset();
    return Step::kJump;
  }
  if (waits_since_.isZero()) waits_since_ = now;
  const bool waited_enough = now - waits_since_ > ros::Duration(options_.max_latency);
  if (is_first ? !begin(waited_enough, missing) : end <= last_end_)
    return waited_enough ? Step::kStalled : Step::kWaiting;
  waits_since_ = now;
  if (is_first) return Step::kWaiting;

  time_to_go_back_ += kBackPerTime * (end - last_end_).toSec() - goes_back_;
  time_to_go_back_ = std::min(time_to_go_back_, kBackPerTime * options_.max_cycle);
  goes_back_ = 0.0;
  cycle.start = last_end_;
  cycle.end = last_end_ = end;
  cycle.late.swap(late_);
  late_.clear();
  advancePairs(cycle);
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (hasChanged(body)) changed_[body] = cycle.end;
    versions_[body] = spans_[body].version;
    too_late_[body].clear();
  }
  try {
    follow(cycle);
  } catch (const std::exception& error) {
    setMissing(error.what(), cycle);  // so that the pairs' times are told as not checked, and not lost
  }
  setSpans(cycle);
  return Step::kCycle;
}

void TfTracker::look(const ros::Time& now, std::vector<std::string>& missing) {
  spans_ = history_.takeNews(frames_);
  if (!last_end_.isZero()) goBackToLate();
  ros::Time newest;
  for (const TfHistory::Span& span : spans_) newest = std::max(newest, span.last);
  // Transforms may be stamped ahead of the clock, or come from a bag that is played without one.
  reference_ = now.isZero() || newest.isZero() ? std::max(now, newest) : std::min(now, newest);
  // Where time is simulated, a bag may bring older stamps than the clock's; the wall clock tells their age.
  const ros::Time& clock = ros::Time::isSimTime() ? reference_ : now;
  ends_.assign(bodies_.size(), ros::TIME_MAX);
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const TfHistory::Span& span = spans_[body];
    if (!span.problem.empty()) {
      missing[body] = span.problem;
    } else if (!span.is_static && clock > span.last && clock - span.last > ros::Duration(options_.max_latency)) {
      missing[body] = bodies_[body].frame + " is late by " + seconds(clock - span.last);
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

/// Pairs that were checked by an interpolation that is known now to be wrong begin there again.
void TfTracker::goBackToLate() {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    for (const LateTransforms& late : spans_[body].late) {
      if (late.until <= begin_) continue;
      const ros::Time since = std::max(late.since, begin_);
      bool contradicts = false;
      for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const bool is_its = pairs_[p].body_a == static_cast<int>(body) || pairs_[p].body_b == static_cast<int>(body);
        if (!is_its || times_[p].until <= since) continue;
        times_[p].until = since;
        contradicts = true;
      }
      if (!contradicts) continue;
      merge({late.frame, since, std::min(late.until, last_end_)}, late_);
      const ros::Duration age = last_end_ - since;
      if (age > ros::Duration(options_.max_cycle)) {
        too_late_[body] = "transforms of " + late.frame + " came late, of " + seconds(age) + " before the cycle";
      } else if (!mayGoBack(age)) {
        too_late_[body] = "transforms of " + late.frame + " come late again and again, now by " + seconds(age);
      }
    }
  }
}

/// All bodies that go back in a cycle share the time that is checked again.
bool TfTracker::mayGoBack(const ros::Duration& age) {
  if (age.toSec() > time_to_go_back_) return false;
  goes_back_ = std::max(goes_back_, age.toSec());
  return true;
}

/// The first cycle begins where all bodies are known, or, after some time, all but those that are missing.
bool TfTracker::begin(bool waited_enough, const std::vector<std::string>& missing) {
  const auto earliest = std::min_element(ends_.begin(), ends_.end());
  const ros::Time start = earliest == ends_.end() || *earliest == ros::TIME_MAX ? reference_ : *earliest;
  for (std::size_t body = 0; body < bodies_.size() && !waited_enough; ++body) {
    if (!missing[body].empty() || spans_[body].first > start) return false;  // it may be on the way
  }
  if (start.isZero()) return false;
  begin_ = last_end_ = start;
  times_.assign(pairs_.size(), {start, start});
  return true;
}

ros::Time TfTracker::foremostEnd(const std::vector<std::string>& missing) const {
  ros::Time foremost;
  for (const PlannedPair& pair : pairs_) {
    const ros::Time end = std::min(ends_[pair.body_a], ends_[pair.body_b]);
    const bool is_known = missing[pair.body_a].empty() && missing[pair.body_b].empty();
    if (is_known && end != ros::TIME_MAX) foremost = std::max(foremost, end);
  }
  return foremost.isZero() ? reference_ : foremost;
}

void TfTracker::advancePairs(TrackedCycle& cycle) {
  const std::vector<std::string>& missing = cycle.motion.missing;
  cycle.origin = cycle.start;
  cycle.complete_until = cycle.end;
  cycle.delayed_since = ros::Time();
  is_known_.resize(pairs_.size());
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const int a = pairs_[p].body_a, b = pairs_[p].body_b;
    const bool is_known = missing[a].empty() && missing[b].empty();
    const ros::Time from = times_[p].until;
    const ros::Time until = is_known ? std::max(from, std::min({ends_[a], ends_[b], cycle.end})) : cycle.end;
    times_[p] = {from, until};
    is_known_[p] = is_known;
    cycle.complete_until = std::min(cycle.complete_until, until);
    if (from == until) {
      cycle.delayed_since = cycle.delayed_since.isZero() ? from : std::min(cycle.delayed_since, from);
      continue;
    }
    cycle.origin = std::min(cycle.origin, from);
  }
}

/// The motion is sampled where pairs need it, in parts that may lie apart: a frame that lags behind lets no body be
/// followed over the time since then again.
void TfTracker::follow(TrackedCycle& cycle) {
  CycleMotion& motion = cycle.motion;
  motion.times.clear();
  motion.X_WB.resize(bodies_.size());
  for (std::vector<Isometry3d>& poses : motion.X_WB) poses.clear();
  motion.motion_error.assign(bodies_.size(), 0.0);
  cycle.samples.clear();
  for (const TimePart& part : windowsOf(cycle)) {
    findNeeded(part, cycle);
    copyMotion(cycle, motion.missing);
    sample(part, cycle);
  }
}

/// Disjoint, increasing, and all that pairs are checked over; of pairs that are not checked, the ends.
std::vector<TimePart> TfTracker::windowsOf(const TrackedCycle& cycle) const {
  std::vector<TimePart> parts = {{cycle.origin, cycle.origin}, {cycle.end, cycle.end}};
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto& [from, until] = times_[p];
    if (from == until) continue;
    if (is_known_[p]) {
      parts.push_back(times_[p]);
    } else {
      parts.insert(parts.end(), {{from, from}, {until, until}});
    }
  }
  std::sort(parts.begin(), parts.end(), [](const TimePart& a, const TimePart& b) { return a.from < b.from; });
  std::vector<TimePart> windows;
  for (const TimePart& part : parts) {
    if (windows.empty() || windows.back().until < part.from) {
      windows.push_back(part);
    } else {
      windows.back().until = std::max(windows.back().until, part.until);
    }
  }
  return windows;
}

void TfTracker::findNeeded(const TimePart& part, const TrackedCycle& cycle) {
  needed_.clear();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const ros::Time at = std::max(std::min(cycle.end, ends_[body]), spans_[body].first);
    needed_.push_back({at, at});
  }
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto& [from, until] = times_[p];
    if (!is_known_[p] || from == until || from < part.from || part.until < until) continue;
    for (const int body : {pairs_[p].body_a, pairs_[p].body_b}) {
      TimePart& needed = needed_[body];
      const bool is_first = needed.from == needed.until;
      needed = is_first ? times_[p] : TimePart{std::min(needed.from, from), std::max(needed.until, until)};
    }
  }
}

/// Copies what the pairs need of each body's motion, and finds what is not known of it.
void TfTracker::copyMotion(const TrackedCycle& cycle, std::vector<std::string>& missing) {
  history_.copy(frames_, needed_, cycle.origin, window_);
  const ros::Duration length = cycle.end - cycle.start;
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const std::string& frame = frames_[body];
    const TfHistory::Span& span = spans_[body];
    const TimePart& needed = needed_[body];
    if (!missing[body].empty()) continue;
    const bool is_needed = needed.from < needed.until;
    if (window_.version(body) != span.version) {
      missing[body] = "the way to " + frame + " has just changed";
    } else if (is_needed && needed.from < changed_[body]) {
      missing[body] = span.change + " since then";
    } else if (is_needed && !span.is_static && length > ros::Duration(options_.max_cycle)) {
      missing[body] = "no cycle for " + seconds(length);
    } else if (is_needed && span.first > needed.from) {
      missing[body] = frame + " is known only since " + seconds(span.first - needed.from) + " after the cycle's start";
    } else if (is_needed && window_.longestGap(body) > options_.max_cycle) {
      missing[body] = "no transforms of " + frame + " for " + seconds(ros::Duration(window_.longestGap(body)));
    } else {
      missing[body] = window_.problem(body);
    }
  }
}

void TfTracker::sample(const TimePart& part, TrackedCycle& cycle) {
  CycleMotion& motion = cycle.motion;
  const std::vector<double> times = sampleTimes(part, cycle);
  const std::size_t most = kMostPoses / (bodies_.size() + 1);
  if (cycle.samples.size() + times.size() > most) {
    throw std::runtime_error("more transforms in one cycle than can be followed: " + std::to_string(times.size()));
  }
  MotionSampling sampling = options_.sampling;
  sampling.max_samples = most - std::min(most, motion.times.size());
  pose_times_.assign(bodies_.size(), std::numeric_limits<double>::quiet_NaN());
  poses_.assign(bodies_.size(), Isometry3d::Identity());
  sampled_.missing.swap(motion.missing);
  const MotionSource source = {
      [&](double time, std::vector<Isometry3d>& X_WB) { posesDuring(time, X_WB, sampled_.missing); },
      [&](double start, double end, std::vector<double>& jerk) { boundJerks(start, end, jerk); }};
  sampleMotion(times, source, balls_, sampling, sampled_);
  sampled_.missing.swap(motion.missing);
  cycle.samples.insert(cycle.samples.end(), times.begin(), times.end());
  motion.times.insert(motion.times.end(), sampled_.times.begin(), sampled_.times.end());
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const std::vector<Isometry3d>& poses = sampled_.X_WB[body];
    motion.X_WB[body].insert(motion.X_WB[body].end(), poses.begin(), poses.end());
    motion.motion_error[body] = std::max(motion.motion_error[body], sampled_.motion_error[body]);
  }
}

void TfTracker::setMissing(const std::string& why, TrackedCycle& cycle) {
  needed_.assign(bodies_.size(), {});
  cycle.samples.clear();
  for (const TimePart& part : windowsOf(cycle)) {
    const std::vector<double> times = sampleTimes(part, cycle);
    cycle.samples.insert(cycle.samples.end(), times.begin(), times.end());
  }
  CycleMotion& motion = cycle.motion;
  motion.missing.assign(bodies_.size(), why);
  motion.times = cycle.samples;
  motion.X_WB.assign(bodies_.size(), std::vector<Isometry3d>(motion.times.size(), Isometry3d::Identity()));
  motion.motion_error.assign(bodies_.size(), 0.0);
}

/// Recorded transforms, and the ends of the part and of pairs' times within it.
std::vector<double> TfTracker::sampleTimes(const TimePart& part, const TrackedCycle& cycle) const {
  const double from = (part.from - cycle.origin).toSec(), until = (part.until - cycle.origin).toSec();
  std::vector<double> times = {from, until};
  for (const TimePart& pair : times_) {
    if (pair.from == pair.until) continue;
    for (const ros::Time& end : {pair.from, pair.until}) {
      if (part.from <= end && end <= part.until) times.push_back((end - cycle.origin).toSec());
    }
  }
  for (std::size_t body = 0; body < needed_.size(); ++body) {
    const bool is_needed = needed_[body].from < needed_[body].until;
    if (is_needed && cycle.motion.missing[body].empty()) window_.addRecordedTimes(body, times);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

/// Outside the part that its pairs need a body rests, so that it costs nothing there.
void TfTracker::posesDuring(double time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (!missing[body].empty()) continue;
    const double from = (needed_[body].from - window_.origin()).toSec();
    const double until = (needed_[body].until - window_.origin()).toSec();
    const double known = std::min(std::max(time, from), until);
    if (known == pose_times_[body]) continue;
    pose_times_[body] = known;
    poses_[body] = window_.pose(body, known) * bodies_[body].X_frame_B;
    if (isTooFar(poses_[body])) missing[body] = tooFar(frames_[body]);
  }
  X_WB = poses_;
}

void TfTracker::boundJerks(double start, double end, std::vector<double>& jerk) const {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const double from = (needed_[body].from - window_.origin()).toSec();
    const double until = (needed_[body].until - window_.origin()).toSec();
    jerk[body] = 0.0;
    if (end <= from || start >= until) continue;
    const BoundingBall& ball_B = balls_[body];
    ChainDerivatives motion({bodies_[body].X_frame_B * ball_B.center, ball_B.radius});
    window_.addEdges(body, start, end, motion);
    jerk[body] = motion.jerk();
  }
}

void TfTracker::setSpans(TrackedCycle& cycle) const {
  const std::vector<double>& times = cycle.motion.times;
  const auto waypointAt = [&](const ros::Time& time) {
    const auto waypoint = std::lower_bound(times.begin(), times.end(), (time - cycle.origin).toSec());
    return static_cast<std::size_t>(waypoint - times.begin());
  };
  cycle.motion.spans.clear();
  for (const TimePart& pair : times_) cycle.motion.spans.push_back({waypointAt(pair.from), waypointAt(pair.until)});
}

void TfTracker::posesAt(const ros::Time& time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) const {
  X_WB.assign(bodies_.size(), Isometry3d::Identity());
  missing.resize(bodies_.size());
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    Isometry3d X_WF;
    if (!missing[body].empty() || !history_.lookup(frames_[body], time, X_WF, missing[body])) continue;
    X_WB[body] = X_WF * bodies_[body].X_frame_B;
    if (isTooFar(X_WB[body])) missing[body] = tooFar(frames_[body]);
  }
}

}  // namespace sdf_ccd
