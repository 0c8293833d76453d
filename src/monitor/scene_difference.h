#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Common parts of two scenes: bodies that are the same object, and pairs of such bodies that need the same tests.
class SceneDifference {
 public:
  SceneDifference(const Scene& before, const Scene& now);

  /// Per body of `now`: its index in `before`; -1 if it is new or has changed.
  const std::vector<int>& bodiesBefore() const { return bodies_before_; }

  /// Per pair of `before`: its index in `now`; -1 if it was removed or has changed.
  const std::vector<int>& pairsNow() const { return pairs_now_; }

  /// All other pairs of `now`.
  const std::vector<int>& newPairs() const { return new_pairs_; }

 private:
  std::vector<int> bodies_before_, pairs_now_, new_pairs_;
};

/// Names of the bodies of each pair, A's first.
std::vector<std::pair<std::string, std::string>> pairNames(const Scene& scene);

/// Per pair of names, in either order: its index in `others`; -1 if it is not there.
std::vector<int> findPairs(const std::vector<std::pair<std::string, std::string>>& pairs,
                           const std::vector<std::pair<std::string, std::string>>& others);

}  // namespace sdf_ccd
