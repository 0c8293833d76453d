#include "ros/tf_tracker.h"

#include <algorithm>
#include <cstdio>

namespace sdf_ccd {
namespace {

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f s", value);
  return text;
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
}

void TfTracker::reset() {
  last_end_ = ros::Time();
  waits_since_ = ros::Time();
}

TfTracker::Step TfTracker::next(const ros::Time& now, TrackedCycle& cycle) {
  history_.watchClock(now);
  if (history_.takeJump()) {
    reset();
    return Step::kJump;
  }
  if (waits_since_.isZero()) waits_since_ = now;
  const bool waited_enough = now - waits_since_ > ros::Duration(options_.max_latency);

  std::vector<std::string>& missing = cycle.motion.missing;
  missing.assign(bodies_.size(), "");
  look(now, missing);
  const bool is_first = last_end_.isZero();
  const ros::Time end = is_first ? ros::Time() : foremostEnd(missing);
  if (is_first ? !begin(waited_enough, missing) : end <= last_end_)
    return waited_enough ? Step::kStalled : Step::kWaiting;
  waits_since_ = now;
  if (is_first) return Step::kWaiting;

  cycle.start = last_end_;
  cycle.end = last_end_ = end;
  advancePairs(cycle);
  findGaps(cycle, missing);
  cycle.samples = recordedSamples(cycle);
  const PosesAt poses_at = [&](double seconds, std::vector<Isometry3d>& X_WB) {
    const ros::Time time = cycle.origin + ros::Duration(seconds);
    X_WB.assign(bodies_.size(), Isometry3d::Identity());
    for (std::size_t body = 0; body < bodies_.size(); ++body) {
      // Where a body is not known yet, or not known any more, no pair needs it.
      const ros::Time known = std::min(std::max(time, spans_[body].first), ends_[body]);
      if (missing[body].empty()) poseAt(body, known, X_WB[body], missing[body]);
    }
  };
  sampleMotion(cycle.samples, poses_at, balls_, options_.sampling, cycle.motion);
  setSpans(cycle);
  return Step::kCycle;
}

void TfTracker::look(const ros::Time& now, std::vector<std::string>& missing) {
  spans_ = history_.spans(frames_);
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
    } else if (!span.is_static && clock - span.last > ros::Duration(options_.max_latency)) {
      missing[body] = bodies_[body].frame + " is late by " + seconds((clock - span.last).toSec());
    } else if (!span.is_static) {
      ends_[body] = std::min(span.last, reference_);
    }
  }
}

/// The first cycle begins where all bodies are known, or, after some time, all but those that are missing.
bool TfTracker::begin(bool waited_enough, const std::vector<std::string>& missing) {
  const auto earliest = std::min_element(ends_.begin(), ends_.end());
  const ros::Time start = earliest == ends_.end() || *earliest == ros::TIME_MAX ? reference_ : *earliest;
  for (std::size_t body = 0; body < bodies_.size() && !waited_enough; ++body) {
    if (!missing[body].empty() || spans_[body].first > start) return false;  // it may be on the way
  }
  if (start.isZero()) return false;
  last_end_ = start;
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
  needed_from_.assign(bodies_.size(), cycle.end);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const int a = pairs_[p].body_a, b = pairs_[p].body_b;
    const bool is_known = missing[a].empty() && missing[b].empty();
    const ros::Time from = times_[p].until;
    const ros::Time until = is_known ? std::max(from, std::min({ends_[a], ends_[b], cycle.end})) : cycle.end;
    times_[p] = {from, until};
    cycle.complete_until = std::min(cycle.complete_until, until);
    if (from == until) continue;
    cycle.origin = std::min(cycle.origin, from);
    for (const int body : {a, b}) needed_from_[body] = std::min(needed_from_[body], from);
  }
}

void TfTracker::findGaps(const TrackedCycle& cycle, std::vector<std::string>& missing) const {
  const double length = (cycle.end - cycle.start).toSec();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const ros::Time& from = needed_from_[body];
    if (!missing[body].empty() || spans_[body].is_static || from == cycle.end) continue;
    const std::string& frame = bodies_[body].frame;
    if (length > options_.max_cycle) {
      missing[body] = "no cycle for " + seconds(length);
    } else if (spans_[body].first > from) {
      missing[body] =
          frame + " is known only since " + seconds((spans_[body].first - from).toSec()) + " after the cycle's start";
    } else {
      const double gap = history_.longestGap(frame, from, std::min(ends_[body], cycle.end));
      if (gap > options_.max_cycle) missing[body] = "no transforms of " + frame + " for " + seconds(gap);
    }
  }
}

std::vector<double> TfTracker::recordedSamples(const TrackedCycle& cycle) const {
  std::vector<ros::Time> times = {cycle.origin, cycle.end};
  for (const PairTimes& pair : times_) {
    if (pair.from < pair.until) times.insert(times.end(), {pair.from, pair.until});
  }
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (cycle.motion.missing[body].empty() && !spans_[body].is_static) {
      history_.recordedTimes(bodies_[body].frame, needed_from_[body], cycle.end, times);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<double> samples;
  for (const ros::Time& time : times) samples.push_back((time - cycle.origin).toSec());
  return samples;
}

void TfTracker::setSpans(TrackedCycle& cycle) const {
  const std::vector<double>& times = cycle.motion.times;
  const auto knotAt = [&](const ros::Time& time) {
    const auto knot = std::lower_bound(times.begin(), times.end(), (time - cycle.origin).toSec());
    return static_cast<std::size_t>(knot - times.begin());
  };
  cycle.motion.spans.clear();
  for (const PairTimes& pair : times_) cycle.motion.spans.push_back({knotAt(pair.from), knotAt(pair.until)});
}

bool TfTracker::poseAt(std::size_t body, const ros::Time& time, Isometry3d& X_WB, std::string& problem) const {
  Isometry3d X_WF;
  if (!history_.lookup(bodies_[body].frame, time, X_WF, problem)) return false;
  if (!(X_WF.translation().lpNorm<Eigen::Infinity>() <= kFarthestPose)) {
    char text[64];
    std::snprintf(text, sizeof(text), " is more than %.0g m from the origin", kFarthestPose);
    problem = bodies_[body].frame + text;
    return false;
  }
  X_WB = X_WF * bodies_[body].X_frame_B;
  return true;
}

void TfTracker::posesAt(const ros::Time& time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) const {
  X_WB.assign(bodies_.size(), Isometry3d::Identity());
  missing.resize(bodies_.size());
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (missing[body].empty()) poseAt(body, time, X_WB[body], missing[body]);
  }
}

}  // namespace sdf_ccd
