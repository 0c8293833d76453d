#include "part_depth.h"

namespace sdf_ccd {

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
  const bool inside = isInside(part, p_G);
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
