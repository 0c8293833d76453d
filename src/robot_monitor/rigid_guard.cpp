#include "rigid_guard.h"

#include <algorithm>

namespace sdf_ccd {

RigidGuard::RigidGuard(const Scene& scene)
    : scene_(scene), watch_(scene), is_checked_(scene.bodies.size(), false), moved_(watch_.pairs().size()) {
  for (const PlannedPair& pair : scene.pairs)
    for (const int body : {pair.body_a, pair.body_b}) is_checked_[static_cast<std::size_t>(body)] = true;
}

std::vector<UncheckedPair> RigidGuard::check(const CycleMotion& motion, const std::vector<WaypointSpan>& watched,
                                             const WasKnown& wasKnown) {
  std::vector<UncheckedPair> unchecked;
  std::fill(moved_.begin(), moved_.end(), 0);
  watch_.find(motion, watched, moved_);
  const std::vector<std::string>& missing = motion.missing;
  const bool is_all_known = std::all_of(missing.begin(), missing.end(), [](const auto& why) { return why.empty(); });
  if (is_all_known && std::find(moved_.begin(), moved_.end(), 1) == moved_.end()) return unchecked;
  for (std::size_t p = 0; p < moved_.size(); ++p) {
    const std::string reason =
        moved_[p] ? "rigidly joined in the URDF, but not in tf: do the URDF and tf belong to the same robot? If these "
                    "may touch, name them in allowed_pairs"
                  : whyNotWatched(motion, watched[p], p, wasKnown);
    if (!reason.empty()) unchecked.push_back({pairs()[p].body_a, pairs()[p].body_b, reason});
  }
  return unchecked;
}

/// Why a pair was not watched, of which nothing else tells it: a body that is also in checked pairs is named there. Of
/// a body that tf does not know, nothing contradicts the URDF; nor of two in the same frame.
std::string RigidGuard::whyNotWatched(const CycleMotion& motion, const WaypointSpan& span, std::size_t pair,
                                      const WasKnown& wasKnown) const {
  const PlannedPair& of = pairs()[pair];
  if (span.empty() || scene_.bodies[of.body_a].frame == scene_.bodies[of.body_b].frame) return {};
  for (const int body : {of.body_a, of.body_b}) {
    const std::string& why = motion.missing[static_cast<std::size_t>(body)];
    if (why.empty()) continue;
    return !is_checked_[static_cast<std::size_t>(body)] && wasKnown(body, motion.times[span.first]) ? why : "";
  }
  return {};
}

}  // namespace sdf_ccd
