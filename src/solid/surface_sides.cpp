#include "surface_sides.h"

#include <algorithm>

#include "common/parallel_for.h"
#include "mesh/mesh_edges.h"
#include "mesh/triangle.h"

namespace sdf_ccd {
namespace {

/// The middle of a triangle, and how far from the edges it is.
SideTest::PiecePoint middle(const TriangleMesh& mesh, int triangle) {
  const Corners c = cornersOf(mesh, triangle);
  const Vector3d area_normal = areaNormal(mesh, triangle);
  return {centroid(c), area_normal.normalized(), area_normal.norm() / longestEdge(c) / 3.0, triangle};
}

}  // namespace

Sides SideTest::at(const PiecePoint& piece, const std::vector<int>& layers, std::size_t* visited) const {
  thread_local std::vector<int> near;
  double free = 0.1 * piece.clearance;
  tree_.trianglesWithin(piece.point, free + tolerance_.closest, near);
  if (visited) *visited += near.size();
  for (const int other : near) {
    if (other == piece.triangle || std::binary_search(layers.begin(), layers.end(), other)) continue;
    const MeasuredTriangle& t = tree_.triangle(other);
    free = std::min(free, (t.closest(piece.point) - piece.point).norm() - closestError(t.corners()));
  }
  const double step = 0.5 * free;
  if (step <= 4.0 * tolerance_.layer) return Sides::kUnknown;
  const bool front = interior_.contains(piece.point + step * piece.normal, visited);
  const bool back = interior_.contains(piece.point - step * piece.normal, visited);
  if (front) return back ? Sides::kInterior : Sides::kInward;
  return back ? Sides::kOutward : Sides::kSheet;
}

std::vector<Sides> sidesOfUncut(const TriangleMesh& mesh, const TriangleTree& tree, const Interior& interior,
                                const CutLists& cuts, const SurfaceTolerance& tolerance) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::uint8_t> uncut(count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    uncut[i] = cuts.of[i].empty() && hasCertainPlane(mesh, static_cast<int>(i), tolerance);
  }
  TriangleSets sets(count);
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) {
    const bool pair = last - first == 2 && uncut[first[0].triangle] != 0 && uncut[first[1].triangle] != 0;
    if (pair) sets.join(first[0].triangle, first[1].triangle);
  });
  std::vector<std::int32_t> widest(count, -1);  // per set, by the triangle that names it
  std::vector<double> clearance(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    if (uncut[i] == 0) continue;
    const auto triangle = static_cast<std::int32_t>(i);
    const std::int32_t set = sets.find(triangle);
    const double here = middle(mesh, triangle).clearance;
    if (here > clearance[set]) {
      clearance[set] = here;
      widest[set] = triangle;
    }
  }
  const SideTest test(tree, interior, tolerance);
  std::vector<Sides> of_set(count, Sides::kUnknown);
  parallelFor(std::size_t{0}, count, [&](std::size_t i) {
    if (widest[i] >= 0) of_set[i] = test.at(middle(mesh, widest[i]), {});
  });
  std::vector<Sides> sides(count, Sides::kUnknown);
  for (std::size_t i = 0; i < count; ++i) {
    if (uncut[i] != 0) sides[i] = of_set[sets.find(static_cast<std::int32_t>(i))];
  }
  return sides;
}

}  // namespace sdf_ccd
