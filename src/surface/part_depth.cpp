#include "part_depth.h"

#include <optional>

namespace sdf_ccd {
namespace {

/// Whether the point is inside, if the triangle nearest to it tells: it separates the outside from the inside, and the
/// point is before or behind its middle, so that nothing lies between. At an edge or a corner, other triangles as near
/// may be on the other side.
std::optional<bool> insideBy(const TriangleTree::ClosestPoint& nearest, const Solid& solid, const Vector3d& p_G) {
  constexpr double kFromSides = 1e-4;  // of the distance: far more than the nearest point's rounding
  const bool is_apart = nearest.distance > 1e-9 * (1.0 + p_G.norm());
  if (!is_apart || nearest.triangle < 0 || !solid.separates()[nearest.triangle]) return std::nullopt;
  const Corners& t = solid.tree().triangle(nearest.triangle).corners();
  const Vector3d normal = areaNormal(t);
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k];
    const double from_side = normal.cross(side).dot(nearest.point - t[k]);  // times the lengths of both
    if (!(from_side > kFromSides * nearest.distance * normal.norm() * side.norm())) return std::nullopt;
  }
  return normal.dot(p_G - nearest.point) < 0.0;
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
