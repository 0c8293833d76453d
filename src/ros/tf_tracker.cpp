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

TfTracker::TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const TfTrackerOptions& options)
    : history_(history), bodies_(bodies), options_(options) {
  for (TrackedBody& body : bodies_) {
    body.frame = withoutLeadingSlash(body.frame);
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
  const ros::Time end = cycleEnd(now, missing);
  if (last_end_.isZero() && !waited_enough && !allKnownAt(end, missing))
    return Step::kWaiting;  // they may be on the way
  if (end.isZero() || end <= last_end_) return waited_enough ? Step::kStalled : Step::kWaiting;
  waits_since_ = now;
  const ros::Time start = last_end_;
  last_end_ = end;
  if (start.isZero()) return Step::kWaiting;  // the first cycle begins here

  cycle.start = start;
  cycle.end = end;
  findGaps(cycle, missing);
  cycle.samples = recordedSamples(cycle);
  const PosesAt poses_at = [&](double time, std::vector<Isometry3d>& X_WB) {
    posesAt(start + ros::Duration(time), X_WB, missing);
  };
  sampleMotion(cycle.samples, poses_at, balls_, options_.sampling, cycle.motion);
  return Step::kCycle;
}

ros::Time TfTracker::cycleEnd(const ros::Time& now, std::vector<std::string>& missing) {
  spans_.clear();
  ros::Time newest;
  for (const TrackedBody& body : bodies_) {
    spans_.push_back(history_.span(body.frame));
    newest = std::max(newest, spans_.back().last);
  }
  // Transforms may be stamped ahead of the clock, or come from a bag that is played without one.
  const ros::Time reference = now.isZero() || newest.isZero() ? std::max(now, newest) : std::min(now, newest);
  ros::Time end;
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const TfHistory::Span& span = spans_[body];
    if (!span.problem.empty()) {
      missing[body] = span.problem;
    } else if (!span.is_static && reference - span.last > ros::Duration(options_.max_latency)) {
      missing[body] = bodies_[body].frame + " is late by " + seconds((reference - span.last).toSec());
    } else if (!span.is_static) {
      end = end.isZero() ? span.last : std::min(end, span.last);
    }
  }
  return end.isZero() ? reference : end;
}

bool TfTracker::allKnownAt(const ros::Time& time, const std::vector<std::string>& missing) const {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (!missing[body].empty() || (!spans_[body].is_static && spans_[body].first > time)) return false;
  }
  return true;
}

void TfTracker::findGaps(const TrackedCycle& cycle, std::vector<std::string>& missing) const {
  const double length = (cycle.end - cycle.start).toSec();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (!missing[body].empty() || spans_[body].is_static) continue;
    const std::string& frame = bodies_[body].frame;
    if (length > options_.max_cycle) {
      missing[body] = "no cycle for " + seconds(length);
    } else if (spans_[body].first > cycle.start) {
      missing[body] = frame + " is known only since " + seconds((spans_[body].first - cycle.start).toSec()) +
                      " after the cycle's start";
    } else {
      const double gap = history_.longestGap(frame, cycle.start, cycle.end);
      if (gap > options_.max_cycle) missing[body] = "no transforms of " + frame + " for " + seconds(gap);
    }
  }
}

std::vector<double> TfTracker::recordedSamples(const TrackedCycle& cycle) const {
  std::vector<ros::Time> times = {cycle.start, cycle.end};
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (cycle.motion.missing[body].empty() && !spans_[body].is_static) {
      history_.recordedTimes(bodies_[body].frame, cycle.start, cycle.end, times);
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<double> samples;
  for (const ros::Time& time : times) samples.push_back((time - cycle.start).toSec());
  return samples;
}

void TfTracker::posesAt(const ros::Time& time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) const {
  X_WB.assign(bodies_.size(), Isometry3d::Identity());
  missing.resize(bodies_.size());
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    Isometry3d X_WF;
    if (missing[body].empty() && history_.lookup(bodies_[body].frame, time, X_WF, missing[body])) {
      X_WB[body] = X_WF * bodies_[body].X_frame_B;
    }
  }
}

}  // namespace sdf_ccd
