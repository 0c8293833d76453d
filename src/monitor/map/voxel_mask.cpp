#include "voxel_mask.h"

#include <algorithm>

#include "common/infinity.h"
#include "scene/body_builder.h"
#include "scene/body_surface.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {
namespace {

struct MaskPart {
  Isometry3d X_GM;  // pose of the map's frame in the part's
  const Primitive* primitive;
  const DistanceField* field;  // if it is not a primitive

  /// Where a field has no samples, only its bounds tell on which side of the surface a point is: sample() widens them.
  double distance(const Vector3d& p_M) const {
    const Vector3d p_G = X_GM * p_M;
    if (primitive) return signedDistance(*primitive, p_G);
    const FieldSample known = field->sample(p_G);
    return std::max(known.value - known.error, field->lowerBound(p_G));
  }

  double farthest(const Vector3d& p_M) const {  ///< upper bound of the distance
    const Vector3d p_G = X_GM * p_M;
    if (primitive) return signedDistance(*primitive, p_G);
    const FieldSample known = field->sample(p_G);
    return known.value + known.error;
  }
};

/// The body's surface; made anew if it was prepared without.
std::shared_ptr<const BodySurface> surfaceOf(const Body& body, const BodyDescription& description) {
  if (body.surface) return body.surface;
  MeshPool pool{BodyOptions()};
  return surfaceOf(description, pool);
}

/// Whether a point inside the body's fields may be outside the body: a field has openings, or the inside of a mesh is
/// doubtful.
bool isInsideUncertain(const Body& body) {
  return body.doubtful || std::any_of(body.parts.begin(), body.parts.end(),
                                      [](const BodyPart& part) { return part.field.hasOpenings(); });
}

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
  if (has_fields && hasMesh(description)) {
    mask.surface_distance = [X_BM, surface = surfaceOf(body, description)](const Vector3d& p_M, double limit) {
      const double farthest = 2.0 * limit + surface->deviation;  // the distance if no triangle is nearer
      return surface->tree.closestPoint(X_BM * p_M, farthest).distance - surface->deviation;
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

std::optional<ObjectMask> objectMaskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM) {
  const bool knows_inside = body.parts.size() == description.geometry.size() && !isInsideUncertain(body);
  ObjectMask mask;
  std::vector<MaskPart> parts;
  AlignedBox3d box_B;
  for (std::size_t i = 0; i < description.geometry.size(); ++i) {
    const GeometryDescription& geometry = description.geometry[i];
    const auto* primitive = std::get_if<Primitive>(&geometry.shape);
    if (!primitive && !knows_inside) continue;
    parts.push_back({geometry.X_BG.inverse() * X_BM, primitive, primitive ? nullptr : &body.parts[i].field});
    const AlignedBox3d box = primitive ? boundingBox(*primitive) : body.parts[i].field.surfaceBox();
    if (!box.sizes().allFinite()) {
      mask.radius = kInfinity;
      continue;
    }
    for (int k = 0; k < 8; ++k) box_B.extend(geometry.X_BG * box.corner(AlignedBox3d::CornerType(k)));
  }
  const std::shared_ptr<const BodySurface> surface = hasMesh(description) ? body.surface : nullptr;
  if (parts.empty() && !surface) return std::nullopt;
  if (surface) box_B.extend(boundingBox(surface->mesh));
  if (mask.radius < kInfinity) {
    mask.center_M = X_BM.inverse() * box_B.center();
    mask.radius = 0.5 * box_B.diagonal().norm();
  }
  mask.isWithin = [X_BM, surface, parts = std::move(parts)](const Vector3d& p_M, double limit) {
    if (std::any_of(parts.begin(), parts.end(), [&](const MaskPart& part) { return part.farthest(p_M) <= limit; }))
      return true;
    const double of_triangles = surface ? limit - surface->deviation : 0.0;
    return of_triangles > 0.0 && surface->tree.closestPoint(X_BM * p_M, 2.0 * limit).distance <= of_triangles;
  };
  return mask;
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
