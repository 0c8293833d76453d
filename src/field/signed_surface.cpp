#include "signed_surface.h"

#include <cmath>

namespace sdf_ccd {

SignedSurface::Nearest SignedSurface::nearest(const Vector3d& p) const {
  const TriangleTree::ClosestPoint found = tree().closestPoint(p);
  return {inside(p) ? -found.distance : found.distance, found.triangle};
}

SignedSurface::Nearest SignedSurface::next(const Vector3d& p, const Nearest& last, double step) const {
  const TriangleTree::ClosestPoint found = tree().closestPointNear(p, last.triangle);
  const bool same_side = closed() && found.distance + std::abs(last.distance) > step * (1.0 + 1e-9);
  const bool is_inside = same_side ? last.distance < 0.0 : inside(p);
  return {is_inside ? -found.distance : found.distance, found.triangle};
}

}  // namespace sdf_ccd
