#include "monitor/voxel_mask.h"

#include <algorithm>

#include "body/body_surface.h"
#include "monitor/surface_crossing.h"
#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {
namespace {

struct MaskPart {
  Isometry3d X_GM;  // pose of the map's frame in the part's
  const Primitive* primitive;
  const DistanceField* field;  // if it is not a primitive

  double distance(const Vector3d& p_M) const {
    if (primitive) return signedDistance(*primitive, X_GM * p_M);
    const FieldSample known = field->sample(X_GM * p_M);
    return known.value - known.error;
  }
};

}  // namespace

std::optional<VoxelMask> maskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM) {
  const bool has_fields = body.parts.size() == description.geometry.size();
  std::vector<MaskPart> parts;
  AlignedBox3d box_B;
  for (std::size_t i = 0; i < description.geometry.size(); ++i) {
    const GeometryDescription& geometry = description.geometry[i];
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    if (!primitive && !has_fields) continue;
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : body.parts[i].field.surfaceBox();
    if (!box.sizes().allFinite()) continue;
    for (int k = 0; k < 8; ++k) box_B.extend(geometry.X_BG * box.corner(AlignedBox3d::CornerType(k)));
    parts.push_back({geometry.X_BG.inverse() * X_BM, primitive, primitive ? nullptr : &body.parts[i].field});
  }
  if (parts.empty()) return std::nullopt;
  VoxelMask mask;
  if (body.surface) {
    mask.surface_distance = [X_BM, &surface = *body.surface](const Vector3d& p_M) {
      return surface.tree.closestPoint(X_BM * p_M).distance - surface.deviation;
    };
    mask.is_open = isInsideUncertain(body);
  }
  mask.center_M = X_BM.inverse() * box_B.center();
  mask.radius = 0.5 * box_B.diagonal().norm();
  mask.distance = [parts = std::move(parts)](const Vector3d& p_M) {
    double nearest = parts.front().distance(p_M);
    for (const MaskPart& part : parts) nearest = std::min(nearest, part.distance(p_M));
    return nearest;
  };
  return mask;
}

bool hidesVoxels(const SceneDescription& description, std::size_t body) {
  const std::vector<BodyDescription>& bodies = description.bodies;
  if (bodies[body].is_world || bodies[body].geometry.empty()) return false;
  return std::any_of(bodies.begin(), bodies.end(), [](const BodyDescription& other) { return !other.map.empty(); });
}

double maskError(const Scene& scene) {
  double error = 0.0;
  for (const Body& body : scene.bodies) {
    if (body.is_world) continue;
    for (const BodyPart& part : body.parts) error = std::max(error, 2.0 * part.field.errorBound());
  }
  return error;
}

}  // namespace sdf_ccd
