#include "surface_needs.h"

#include <algorithm>

#include "body/body_builder.h"

namespace sdf_ccd {

std::vector<bool> needSurface(const SceneDescription& description, const std::vector<PlannedPair>& pairs,
                              const std::function<bool(int body)>& isOpen) {
  const std::vector<BodyDescription>& bodies = description.bodies;
  std::vector<bool> need(bodies.size(), false);
  for (const PlannedPair& pair : pairs)
    if (isOpen(pair.body_a) || isOpen(pair.body_b)) need[pair.body_a] = need[pair.body_b] = true;
  const bool has_map = std::any_of(bodies.begin(), bodies.end(), [](const auto& body) { return !body.map.empty(); });
  for (std::size_t b = 0; b < bodies.size() && has_map; ++b)
    if (!bodies[b].is_world && hasMesh(bodies[b])) need[b] = true;
  return need;
}

}  // namespace sdf_ccd
