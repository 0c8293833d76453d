#include "no_pairs.h"

#include <algorithm>
#include <map>

namespace sdf_ccd {

std::string whyNoPairs(const Scene& scene) {
  if (!scene.pairs.empty()) return {};
  std::map<std::string, std::size_t> count;  // of pairs by reason
  for (const PairDecision& pair : scene.left_out) ++count[pair.text];
  const std::string begin = "nothing is checked: ";
  if (!count.empty()) {
    const auto most =
        std::max_element(count.begin(), count.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    return begin + "all pairs are left out, " + std::to_string(most->second) + " of them because of: " + most->first;
  }
  if (scene.bodies.size() == 0) return begin + "there is no body";
  if (scene.bodies.size() == 1) return begin + "there is only the body " + scene.bodies[0].name;
  return begin + "all bodies are the world's";
}

}  // namespace sdf_ccd
