#include "monitor/voxel_mask.h"

#include <algorithm>

#include "body/body_surface.h"
#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {
namespace {

struct Solid {
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
  std::vector<Solid> solids;
  AlignedBox3d box_B;
  for (std::size_t i = 0; i < description.geometry.size(); ++i) {
    const GeometryDescription& geometry = description.geometry[i];
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    if (!primitive && !has_fields) continue;
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : body.parts[i].field.surfaceBox();
    if (!box.sizes().allFinite()) continue;
    for (int k = 0; k < 8; ++k) box_B.extend(geometry.X_BG * box.corner(AlignedBox3d::CornerType(k)));
    solids.push_back({geometry.X_BG.inverse() * X_BM, primitive, primitive ? nullptr : &body.parts[i].field});
  }
  if (solids.empty()) return std::nullopt;
  VoxelMask mask;
  const bool has_openings = has_fields && std::any_of(body.parts.begin(), body.parts.end(), [](const BodyPart& part) {
                              return part.field.openings() != nullptr;
                            });
  if (has_openings && body.surface) {
    mask.surface_distance = [X_BM, &surface = *body.surface](const Vector3d& p_M) {
      return surface.tree.closestPoint(X_BM * p_M).distance - surface.deviation;
    };
  }
  mask.center_M = X_BM.inverse() * box_B.center();
  mask.radius = 0.5 * box_B.diagonal().norm();
  mask.distance = [solids = std::move(solids)](const Vector3d& p_M) {
    double nearest = solids.front().distance(p_M);
    for (const Solid& solid : solids) nearest = std::min(nearest, solid.distance(p_M));
    return nearest;
  };
  return mask;
}

}  // namespace sdf_ccd
