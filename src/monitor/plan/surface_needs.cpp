#include "surface_needs.h"

#include <algorithm>

#include "body/body_builder.h"

namespace sdf_ccd {
namespace {


/// Whether the body is an object with a mesh, whose voxels in a live map are judged as the object.
bool mayBeInMap(const SceneDescription& description, const BodyDescription& body) {
  return description.has_live_map && body.map.empty() &&
         std::any_of(body.geometry.begin(), body.geometry.end(), [](const GeometryDescription& geometry) {
           return !geometry.watertight_voxels && !std::holds_alternative<Primitive>(geometry.shape);
         });
}

}  // namespace

bool hidesVoxels(const SceneDescription& description, const BodyDescription& body) {
  return description.has_live_map && !body.is_world && hasMesh(body);
}

std::vector<bool> needSurface(const SceneDescription& description, const std::vector<PlannedPair>& pairs,
                              const std::function<bool(int body)>& isOpen) {
  std::vector<bool> need;
  for (const BodyDescription& body : description.bodies) need.push_back(hidesVoxels(description, body) || mayBeInMap(description, body));
  for (const PlannedPair& pair : pairs)
    if (isOpen(pair.body_a) || isOpen(pair.body_b)) need[pair.body_a] = need[pair.body_b] = true;
  return need;
}

}  // namespace sdf_ccd
