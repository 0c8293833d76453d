#pragma once

#include <functional>
#include <vector>

#include "monitor/rigid_watch.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Checks the assumption behind pairs that a scene leaves out as rigidly joined: that tf has them where the URDF does.
class RigidGuard {
 public:
  /// @param scene  must outlive this.
  explicit RigidGuard(const Scene& scene);

  const std::vector<PlannedPair>& pairs() const { return watch_.pairs(); }

  /// Whether the pose of a body was known at a time of the motion [s], whatever became of it.
  using WasKnown = std::function<bool(int body, double time)>;

  /// The pairs for which that does not hold in the part of the motion over which they are watched, or which were not
  /// watched.
  /// @param watched  per pair, as CycleMotion::spans.
  std::vector<UncheckedPair> check(const CycleMotion& motion, const std::vector<WaypointSpan>& watched,
                                   const WasKnown& wasKnown);

 private:
  std::string whyNotWatched(const CycleMotion& motion, const WaypointSpan& span, std::size_t pair,
                            const WasKnown& wasKnown) const;

  const Scene& scene_;
  RigidWatch watch_;
  std::vector<bool> is_checked_;  // per body: is in a pair that is checked
  std::vector<char> moved_;       // per pair, in the last motion
};

}  // namespace sdf_ccd
