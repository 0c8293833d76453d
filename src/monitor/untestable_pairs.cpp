#include "untestable_pairs.h"

#include <cstddef>
#include <vector>

#include "common/counted.h"
#include "scene/name_pair.h"
#include "scene/pair_bound.h"

namespace sdf_ccd {

const char* const kNotTestable = "both have half-spaces";

std::string warnOfUntestable(Scene& scene) {
  constexpr std::size_t kNamed = 4;  // of possibly very many tiles of a map
  std::vector<std::string> names;
  for (const PlannedPair& pair : scene.pairs) {
    const bool are_checkable = scene.bodies[pair.body_a].failure.empty() && scene.bodies[pair.body_b].failure.empty();
    if (!haveSurfaces(scene, pair) && are_checkable) names.push_back(pairName(scene, pair));
  }
  if (names.empty()) return {};
  const std::string warning =
      counted(names.size(), "pair") + " cannot be checked, as " + kNotTestable + ": " + firstOf(names, kNamed);
  scene.warnings.push_back(warning);
  return warning;
}

}  // namespace sdf_ccd
