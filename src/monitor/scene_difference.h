#pragma once

#include <string>
#include <utility>
#include <vector>

#include "body_twists.h"
#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// What two scenes have in common: bodies that are the same object, and pairs of such that are tested in the same way.
class SceneDifference {
 public:
  SceneDifference(const Scene& before, const Scene& now);

  /// Per body now: its index before; -1 if it is new, or has changed.
  const std::vector<int>& bodiesBefore() const { return bodies_before_; }

  /// Per pair before: its index now; -1 if it is gone, or has changed.
  const std::vector<int>& pairsNow() const { return pairs_now_; }

  /// Bodies that stay, in rows of both scenes.
  std::vector<BodyRun> bodyRuns() const;

 private:
  std::vector<int> bodies_before_, pairs_now_;
};

/// Names of the bodies of each pair, A's first.
std::vector<std::pair<std::string, std::string>> pairNames(const Scene& scene);

/// Per pair of names, either way round: its index in the others; -1 if it is not there.
std::vector<int> findPairs(const std::vector<std::pair<std::string, std::string>>& pairs,
                           const std::vector<std::pair<std::string, std::string>>& others);

}  // namespace sdf_ccd
