#include "surface_tolerance.h"

#include <algorithm>

#include "mesh/box_measures.h"

namespace sdf_ccd {

SurfaceTolerance surfaceTolerance(const TriangleMesh& mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  // Far from the origin, the corners of cut pieces are rounded to 1e-16 of their coordinates.
  const double size = std::max(box.sizes().maxCoeff(), 1e-4 * largestCoordinate(box));
  return {1e-10 * size, 1e-9 * size, 1e-14 * size, 1e-7 * size};
}

double closestError(const Corners& c) {
  const double longest = longestEdge(c);
  if (!(longest > 0.0)) return 0.0;
  const double thinness = areaNormal(c).norm() / (longest * longest);
  // For thinner triangles, closest points are also searched on the edges, and those of the interior lose fewer digits.
  constexpr double kSliver = 1e-4;
  const double lost = thinness > kSliver ? 4e-16 / (thinness * thinness) : 1e-15 / std::max(thinness, 1e-300);
  return longest * std::min(thinness, lost);
}

bool hasCertainPlane(const TriangleMesh& mesh, int triangle, const SurfaceTolerance& tolerance) {
  const double longest = longestEdge(cornersOf(mesh, triangle));
  const double height = areaNormal(mesh, triangle).norm() / std::max(longest, 1e-300);
  return height > 1e-6 * longest && height > tolerance.border;
}

}  // namespace sdf_ccd
