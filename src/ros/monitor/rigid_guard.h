#pragma once

#include <vector>

#include "monitor/rigid_watch.h"
#include "ros/tf/tf_tracker.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Checks the assumption behind pairs that a scene leaves out as rigidly joined: that tf has them where the URDF does.
class RigidGuard {
 public:
  /// @param scene  must outlive this.
  explicit RigidGuard(const Scene& scene);

  const std::vector<PlannedPair>& pairs() const { return watch_.pairs(); }

  /// The pairs for which that does not hold in the part of the cycle over which they are watched, or which were not
  /// watched.
  std::vector<UncheckedPair> check(const TfHistory& history, const TrackedCycle& cycle);

 private:
  std::string whyNotWatched(const TfHistory& history, const TrackedCycle& cycle, std::size_t pair) const;

  const Scene& scene_;
  RigidWatch watch_;
  std::vector<bool> is_checked_;  // per body: is in a pair that is checked
  std::vector<char> moved_;       // per pair, in the last cycle
};

}  // namespace sdf_ccd
