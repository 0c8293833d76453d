#include "sdf_ccd/geometry/separating_triangles.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "mesh_edges.h"
#include "surface_sides.h"
#include "triangle_cuts.h"

namespace sdf_ccd {
namespace {

/// For each triangle, whether the neighbours at all its edges agree with it about the outside.
std::vector<std::uint8_t> agreeWithNeighbours(const TriangleMesh& mesh, const std::vector<EdgeUse>& uses) {
  std::vector<std::uint8_t> agree(mesh.triangles.size(), 1);
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (imbalance(first, last) == 0) return;
    for (; first != last; ++first) agree[first->triangle] = 0;
  });
  return agree;
}

/// Whether a triangle of an open mesh faces the outside, as what lies just before and behind it says.
bool facesOutside(const TriangleMesh& mesh, const Interior& interior, int triangle) {
  const Vector3i& t = mesh.triangles[triangle];
  const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  const Vector3d center = (a + b + c) / 3.0;
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  // Near enough that nothing else lies between, far enough for rounding.
  const Vector3d step = 1e-6 * areaNormal(mesh, triangle) / longest;
  for (const Vector3d& towards : {center, a, b, c}) {
    const Vector3d p = center + 0.9 * (towards - center);
    if (interior.contains(p + step)) return false;
    if (!interior.contains(p - step)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> separatingTriangles(const TriangleMesh& mesh, const TriangleTree& tree,
                                              const Interior& interior) {
  const SurfaceTolerance tolerance = surfaceTolerance(mesh);
  const TriangleCuts cuts = triangleCuts(mesh, tree, tolerance, 0);
  std::vector<std::uint8_t> separates(mesh.triangles.size(), 0);
  if (interior.closed()) {
    const std::vector<Sides> sides = sidesOfUncut(mesh, tree, interior, cuts, tolerance);
    std::transform(sides.begin(), sides.end(), separates.begin(), [](Sides s) { return s == Sides::kOutward; });
    return separates;
  }
  const std::vector<std::uint8_t> agrees = agreeWithNeighbours(mesh, edgeUses(mesh));
  tbb::parallel_for(std::size_t{0}, separates.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    separates[i] = agrees[i] != 0 && cuts.of[i].empty() && hasCertainPlane(mesh, triangle, tolerance) &&
                   facesOutside(mesh, interior, triangle);
  });
  return separates;
}

}  // namespace sdf_ccd
