#include "part_depth.h"

#include <cmath>
#include <optional>

namespace sdf_ccd {
namespace {

/// Whether the point is inside, if the triangle nearest to it tells: it separates the outside from the inside, nothing
/// lies between its nearest point and `p_G`, and these are connected by its normal.
std::optional<bool> insideBy(const TriangleTree::ClosestPoint& nearest, const Solid& solid, const Vector3d& p_G) {
  constexpr double kParallel = 1.0 - 1e-9;
  if (nearest.triangle < 0 || !solid.separates()[nearest.triangle]) return std::nullopt;
  const Vector3d normal = areaNormal(solid.tree().triangle(nearest.triangle).corners());
  const double along = normal.dot(p_G - nearest.point);
  const bool is_before = std::abs(along) > kParallel * normal.norm() * nearest.distance;
  return is_before && nearest.distance > 1e-9 * (1.0 + p_G.norm()) ? std::optional(along < 0.0) : std::nullopt;
}

}  // namespace

bool isInside(const SolidPart& part, const Vector3d& p_G) {
  const DistanceBounds bounds = part.field->bounds(p_G);
  return bounds.high < 0.0 || (bounds.low <= 0.0 && part.solid->inside(p_G));
}

PartDepth depthIn(const SolidPart& part, const Vector3d& p_G) {
  if (!part.solid) {
    const FieldValue value = part.field->interpolate(p_G);
    return {-value.value, -1, value.gradient.normalized()};
  }
  const TriangleTree& tree = part.solid->tree();
  const TriangleTree::ClosestPoint nearest = tree.closestPoint(p_G);
  const std::optional<bool> is_behind = insideBy(nearest, *part.solid, p_G);
  const bool inside = is_behind ? *is_behind : isInside(part, p_G);
  Vector3d out = (inside ? 1.0 : -1.0) * (nearest.point - p_G);
  // On the surface (up to rounding) the outward direction is the triangle's own normal.
  if (!(nearest.distance > 1e-9 * (1.0 + p_G.norm()))) out = areaNormal(tree.triangle(nearest.triangle).corners());
  return {inside ? nearest.distance : -nearest.distance, nearest.triangle, out.normalized()};
}

PartDepth depthIn(const std::vector<SolidPart>& solid, const Vector3d& p) {
  PartDepth deepest;
  for (const SolidPart& part : solid) {
    const Vector3d p_G = part.X_GB * p;
    if (-part.field->lowerBound(p_G) <= deepest.depth) continue;
    PartDepth depth = depthIn(part, p_G);
    if (depth.depth <= deepest.depth) continue;
    depth.out = part.X_GB.linear().transpose() * depth.out;
    deepest = depth;
  }
  return deepest;
}

}  // namespace sdf_ccd
