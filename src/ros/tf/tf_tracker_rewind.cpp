// Part of TfTracker: pairs whose time is checked again, or for the first time after newer ones.
#include <algorithm>

#include "common/number_text.h"
#include "ros/tf/seconds_between.h"
#include "ros/tf/tf_tracker.h"

namespace sdf_ccd {
namespace {

/// Adds it to the entry of the same frame, if there is one.
void merge(const LateTransforms& late, std::vector<LateTransforms>& all) {
  const auto same =
      std::find_if(all.begin(), all.end(), [&](const LateTransforms& other) { return other.frame == late.frame; });
  if (same == all.end()) return all.push_back(late);
  same->since = std::min(same->since, late.since);
  same->until = std::max(same->until, late.until);
}

}  // namespace

/// Sets back the pairs of frames that have just become known, to where their transforms begin: these may be older than
/// the last cycle, as after a gap in the network, and their time was not checked.
void TfTracker::rewindNewPairs() {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const TfSpan& span = spans_[body];
    if (was_known_[body] || !span.problem.empty() || span.first >= last_end_) continue;
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const auto a = static_cast<std::size_t>(pairs_[p].body_a), b = static_cast<std::size_t>(pairs_[p].body_b);
      if (a != body && b != body) continue;
      const TfSpan& other = spans_[a == body ? b : a];
      if (!other.problem.empty()) continue;
      storePairTimes();
      const ros::Time since = std::max({begin_, added_[a], added_[b], span.first, other.first});
      const double age = secondsBetween(since, times_[p].until);
      if (age > 0.0 && age <= options_.max_cycle && mayRewind(age)) times_[p].until = since;
    }
  }
}

/// Sets back the pairs that were checked with an interpolation now known to be wrong.
void TfTracker::rewindLatePairs() {
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    for (const LateTransforms& late : spans_[body].late) {
      if (late.until <= begin_) continue;
      const ros::Time since = std::max(late.since, begin_);
      bool contradicts = false;
      storePairTimes();
      for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const bool is_its = pairs_[p].body_a == static_cast<int>(body) || pairs_[p].body_b == static_cast<int>(body);
        if (!is_its || times_[p].until <= since) continue;
        times_[p].until = since;
        contradicts = true;
      }
      if (!contradicts) continue;
      merge({late.frame, since, std::min(late.until, last_end_)}, late_);
      const double age = secondsBetween(since, last_end_);
      if (age > options_.max_cycle) {
        too_late_[body] = "transforms of " + late.frame + " arrived late, for times up to " + secondsText(age, 2) +
                          " before the cycle";
      } else if (!mayRewind(age)) {
        too_late_[body] = "transforms of " + late.frame + " arrive late repeatedly, now by " + secondsText(age, 2);
      }
    }
  }
}

/// All bodies that are set back in one cycle share the time that is checked again.
bool TfTracker::mayRewind(double age) {
  if (age > rewind_budget_) return false;
  rewound_ = std::max(rewound_, age);
  return true;
}

}  // namespace sdf_ccd
