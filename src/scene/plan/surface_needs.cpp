#include "surface_needs.h"

#include <algorithm>

#include "scene/body_builder.h"

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

bool needsSurface(const SceneDescription& description, const BodyDescription& body) {
  return hidesVoxels(description, body) || mayBeInMap(description, body);
}

}  // namespace sdf_ccd
