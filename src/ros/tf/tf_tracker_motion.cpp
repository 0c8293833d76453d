// Part of TfTracker: the bodies' motion over a cycle.
#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "common/number_text.h"
#include "motion/valid_pose.h"
#include "ros/tf/seconds_between.h"
#include "ros/tf/tf_tracker.h"

namespace sdf_ccd {
namespace {

bool operator==(const TimePart& a, const TimePart& b) {
  return a.from == b.from && a.until == b.until;
}

/// Sorts the values from an index on and removes duplicates.
void sortOnce(std::vector<double>& values, std::size_t from) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
  std::sort(first, values.end());
  values.erase(std::unique(first, values.end()), values.end());
}

constexpr double kFastest = 1000.0, kJump = 100.0;  // see TfTracker: of a frame that has jumped [m/s, m]

/// Period in which a body is needed, in the time of the samples [s].
struct Needed {
  double from, until;
};
Needed secondsOf(const TimePart& part, const ros::Time& origin) {
  return {(part.from - origin).toSec(), (part.until - origin).toSec()};
}

std::string longerThan(double max_cycle) {
  return ", longer than max_cycle (" + secondsText(max_cycle, 2) + ")";
}

}  // namespace

/// Samples the motion where pairs need it, in parts that may lie apart: if one frame lags behind, the other bodies are
/// not sampled again over the time since then.
void TfTracker::sampleParts(TrackedCycle& cycle) {
  CycleMotion& motion = cycle.motion;
  motion.times.clear();
  motion.X_WB.resize(bodies_.size());
  for (std::vector<Isometry3d>& poses : motion.X_WB) poses.clear();
  motion.motion_error.assign(bodies_.size(), 0.0);
  cycle.samples.clear();
  cycle.recorded.clear();
  cycle.gaps.assign(bodies_.size(), 0.0);
  findWindows(cycle);
  for (const TimePart& part : windows_) {
    findNeeded(part, cycle);
    copyMotion(cycle, motion.missing);
    for (std::size_t body = 0; body < bodies_.size(); ++body)
      if (needed_[body].from < needed_[body].until) cycle.gaps[body] = std::max(cycle.gaps[body], window_.gaps(body));
    sample(part, cycle);
  }
  findJumps(motion);
}

/// Reports bodies that move faster than any robot, also as seen from a body that they are checked against: a map's
/// frame was set to another pose, for example. Such a body swept nothing on its path, and testing all of the path would
/// take seconds.
///
/// Both are measured at the bodies' balls. The origin of a frame may be kilometres away from what is in it, and moves
/// at thousands of metres per second in the frame of a robot that merely turns there. So does a body at that distance,
/// and the ball of a half-space says nothing about it near the robot: hence the view from the other body.
void TfTracker::findJumps(CycleMotion& motion) const {
  const std::size_t samples = motion.times.size();
  const auto jump = [&](const auto& pointAt) {
    double jumped = 0.0;
    for (std::size_t k = 1; k < samples; ++k) {
      const double distance = (pointAt(k) - pointAt(k - 1)).norm();
      if (distance > kFastest * (motion.times[k] - motion.times[k - 1])) jumped += distance;
    }
    return jumped > kJump ? jumped : 0.0;
  };
  const auto isKnown = [&](std::size_t body) { return motion.missing[body].empty() && !motion.X_WB[body].empty(); };
  const auto center_W = [&](std::size_t body, std::size_t k) -> Vector3d {
    return motion.pose(static_cast<int>(body), k) * bodies_[body].ball_B.center;
  };
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (!isKnown(body) || motion.X_WB[body].size() < samples) continue;
    const double jumped = jump([&](std::size_t k) { return center_W(body, k); });
    if (jumped == 0.0) continue;
    const auto isSeenBy = [&](std::size_t other) {
      return isKnown(other) && jump([&](std::size_t k) -> Vector3d {
               return motion.X_WB[body][k].inverse() * center_W(other, k);
             }) > 0.0;
    };
    const bool is_seen = std::any_of(pairs_.begin(), pairs_.end(), [&](const PlannedPair& pair) {
      const auto a = static_cast<std::size_t>(pair.body_a), b = static_cast<std::size_t>(pair.body_b);
      return (a == body && isSeenBy(b)) || (b == body && isSeenBy(a));
    });
    if (is_seen) motion.missing[body] = fmt::format("{} has jumped by {:.0f} m", frames_[body], jumped);
  }
}

/// Finds the disjoint, increasing parts over which pairs are checked; of pairs that are not checked, the ends of their
/// times.
void TfTracker::findWindows(const TrackedCycle& cycle) {
  windows_.clear();
  if (are_together_) return windows_.push_back(together_);
  checked_ = {{cycle.origin, cycle.origin}, {cycle.end, cycle.end}};
  const auto add = [&](const TimePart& part) {
    if (!(part == checked_.back())) checked_.push_back(part);
  };
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto& [from, until] = times_[p];
    if (from == until) continue;
    if (is_known_[p]) {
      add(times_[p]);
    } else {
      add({from, from});
      add({until, until});
    }
  }
  std::sort(checked_.begin(), checked_.end(), [](const TimePart& a, const TimePart& b) { return a.from < b.from; });
  for (const TimePart& part : checked_) {
    if (windows_.empty() || windows_.back().until < part.from) {
      windows_.push_back(part);
    } else {
      windows_.back().until = std::max(windows_.back().until, part.until);
    }
  }
}

void TfTracker::findNeeded(const TimePart& part, const TrackedCycle& cycle) {
  needed_.clear();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const ros::Time at = std::max(std::min(cycle.end, ends_[body]), spans_[body].first);
    needed_.push_back(are_together_ && is_paired_[body] ? part : TimePart{at, at});
  }
  if (are_together_) return;
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

/// Copies the parts of each body's motion that its pairs need, and finds what is not known of them.
void TfTracker::copyMotion(const TrackedCycle& cycle, std::vector<std::string>& missing) {
  history_.copy(chains_, needed_, cycle.origin, window_);
  const double length = secondsBetween(cycle.start, cycle.end);
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const std::string& frame = frames_[body];
    const TfSpan& span = spans_[body];
    const TimePart& needed = needed_[body];
    if (!missing[body].empty()) continue;
    const bool is_needed = needed.from < needed.until;
    if (window_.version(body) != span.version) {
      missing[body] = "the transforms above " + frame + " have just changed";
    } else if (is_needed && needed.from < changed_[body]) {
      missing[body] = span.change + " since then";
    } else if (is_needed && !span.is_static && length > options_.max_cycle) {
      missing[body] = "no cycle for " + secondsText(length, 2) + longerThan(options_.max_cycle);
    } else if (is_needed && span.first > needed.from) {
      missing[body] = frame + " is known only since " + secondsText(secondsBetween(needed.from, span.first), 2) +
                      " after the cycle's start";
    } else if (is_needed && window_.longestGap(body) > options_.max_cycle) {
      missing[body] = "no transforms of " + frame + " for " + secondsText(window_.longestGap(body), 2) +
                      longerThan(options_.max_cycle);
    } else {
      missing[body] = window_.problem(body);
    }
  }
}

void TfTracker::sample(const TimePart& part, TrackedCycle& cycle) {
  findSampleTimes(part, cycle);
  if ((cycle.samples.size() + sample_times_.size()) * moving_.size() > kMaxPoses) {
    throw std::runtime_error(fmt::format("too many transforms in one cycle: {} times of {} bodies that move",
                                         sample_times_.size(), moving_.size()));
  }
  pose_times_.assign(bodies_.size(), std::numeric_limits<double>::quiet_NaN());
  poses_.assign(bodies_.size(), Isometry3d::Identity());
  placeStatic(cycle.motion);
  std::vector<std::string>& missing = cycle.motion.missing;
  const MotionSource source = {
      [&](double time, std::vector<Isometry3d>& X_WB) { posesDuring(time, X_WB, missing); },
      [&](double start, double end, std::vector<double>& jerk) { boundJerks(start, end, jerk); }};
  sampler_.add(sample_times_, source, moving_, cycle.motion);
  cycle.samples.insert(cycle.samples.end(), sample_times_.begin(), sample_times_.end());
}

void TfTracker::setMissing(const std::string& why, TrackedCycle& cycle) {
  needed_.assign(bodies_.size(), {});
  cycle.samples.clear();
  cycle.recorded.clear();
  findWindows(cycle);
  for (const TimePart& part : windows_) {
    findSampleTimes(part, cycle);
    cycle.samples.insert(cycle.samples.end(), sample_times_.begin(), sample_times_.end());
  }
  CycleMotion& motion = cycle.motion;
  motion.missing.assign(bodies_.size(), why);
  motion.times = cycle.samples;
  motion.X_WB.resize(bodies_.size());
  for (std::vector<Isometry3d>& poses : motion.X_WB) poses.assign(1, Isometry3d::Identity());
  motion.motion_error.assign(bodies_.size(), 0.0);
}

/// Finds the recorded transforms, and the ends of the part and of pairs' times within it.
void TfTracker::findSampleTimes(const TimePart& part, TrackedCycle& cycle) {
  std::vector<double>& times = sample_times_;
  times = {(part.from - cycle.origin).toSec(), (part.until - cycle.origin).toSec()};
  if (!are_together_) addPairTimes(part, cycle.origin);
  listed_.clear();
  for (std::size_t body = 0; body < needed_.size(); ++body) {
    const bool is_needed = needed_[body].from < needed_[body].until;
    if (is_needed && cycle.motion.missing[body].empty()) listed_.push_back(body);
  }
  const std::size_t first = cycle.recorded.size();
  window_.addRecordedTimes(listed_, times, cycle.recorded);
  sortOnce(times, 0);
  sortOnce(cycle.recorded, first);
}

/// There are many pairs, but few different times.
void TfTracker::addPairTimes(const TimePart& part, const ros::Time& origin) {
  pair_times_.clear();
  for (const TimePart& pair : times_) {
    if (pair.from == pair.until) continue;
    for (const ros::Time& end : {pair.from, pair.until}) {
      if (end < part.from || part.until < end) continue;
      const auto place = std::lower_bound(pair_times_.begin(), pair_times_.end(), end);
      if (place == pair_times_.end() || *place != end) pair_times_.insert(place, end);
    }
  }
  for (const ros::Time& end : pair_times_) sample_times_.push_back((end - origin).toSec());
}

/// Sets the single pose of each body at rest.
void TfTracker::placeStatic(CycleMotion& motion) {
  for (const std::size_t body : static_) {
    std::string& missing = motion.missing[body];
    if (missing.empty()) {
      poses_[body] = window_.pose(body, secondsOf(needed_[body], window_.origin()).from) * bodies_[body].X_frame_B;
      if (!isNearOrigin(poses_[body].translation())) missing = tooFar(frames_[body]);
    }
    motion.X_WB[body].assign(1, poses_[body]);
  }
}

/// Outside the part that its pairs need, a body is at rest and costs nothing.
void TfTracker::posesDuring(double time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) {
  const Needed together = secondsOf(together_, window_.origin());
  X_WB.resize(bodies_.size());
  for (const std::size_t body : moving_) {
    const auto [from, until] =
        are_together_ && is_paired_[body] ? together : secondsOf(needed_[body], window_.origin());
    const double known = std::min(std::max(time, from), until);
    if (known != pose_times_[body] && missing[body].empty()) {
      pose_times_[body] = known;
      poses_[body] = window_.pose(body, known) * bodies_[body].X_frame_B;
      if (!isNearOrigin(poses_[body].translation())) missing[body] = tooFar(frames_[body]);
    }
    X_WB[body] = poses_[body];
  }
}

void TfTracker::boundJerks(double start, double end, std::vector<double>& jerk) {
  const Needed together = secondsOf(together_, window_.origin());
  for (const std::size_t body : moving_) {
    const auto [from, until] =
        are_together_ && is_paired_[body] ? together : secondsOf(needed_[body], window_.origin());
    const bool rests = from == until || end <= from || start >= until;
    jerk[body] = rests ? 0.0 : window_.derivatives(body, distances_[body], start, end).third;
  }
}

void TfTracker::setSpans(TrackedCycle& cycle) const {
  const std::vector<double>& times = cycle.motion.times;
  std::vector<WaypointSpan>&spans = cycle.motion.spans, &watched = cycle.watched;
  spans.clear();
  spans.reserve(checked_pairs_);  // now, so that a later cycle with a frame that lags behind does not allocate
  if (are_together_) {            // then no spans are needed
    return watched.assign(pairs_.size() - checked_pairs_, {0, times.size() - 1});
  }
  const auto waypointAt = [&](const ros::Time& time) {
    const auto waypoint = std::lower_bound(times.begin(), times.end(), (time - cycle.origin).toSec());
    return static_cast<std::size_t>(waypoint - times.begin());
  };
  watched.clear();
  WaypointSpan span;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const bool is_as_last = p > 0 && times_[p] == times_[p - 1];
    if (!is_as_last) span = {waypointAt(times_[p].from), waypointAt(times_[p].until)};
    (p < checked_pairs_ ? spans : watched).push_back(span);
  }
}

}  // namespace sdf_ccd
