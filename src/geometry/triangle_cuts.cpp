#include "triangle_cuts.h"

#include <algorithm>
#include <atomic>

#include <tbb/enumerable_thread_specific.h>

#include "common/parallel_for.h"
#include "triangle_cut.h"

namespace sdf_ccd {
namespace {

/// Data of a triangle for all tests against others, measured once.
struct Measured {
  Vector3d normal;  ///< of length one, or zero
  double error;     ///< see closestError()
  bool certain;     ///< see hasCertainPlane()
};

/// Whether two triangles of a mesh cut or overlap each other elsewhere than at shared vertices and edges.
bool cut(const TriangleMesh& mesh, const std::vector<Measured>& measured, int first, int second, double tolerance) {
  const Vector3i &i = mesh.triangles[first], &j = mesh.triangles[second];
  const Measured &a = measured[first], &b = measured[second];
  const int shared = sharedVertices(i, j);
  if (shared == 3) return true;
  if (shared == 2) return a.normal.dot(b.normal) < -0.999999;
  return meet({i, cornersOf(mesh, first), a.normal}, {j, cornersOf(mesh, second), b.normal},
              tolerance + a.error + b.error);
}

}  // namespace

double closestError(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double longest = longestEdge({a, b, c});
  if (!(longest > 0.0)) return 0.0;
  const double thinness = (b - a).cross(c - a).norm() / (longest * longest);
  // For thinner triangles, closest points are also searched on the edges, and those of the interior lose fewer digits.
  constexpr double kSliver = 1e-4;
  const double lost = thinness > kSliver ? 4e-16 / (thinness * thinness) : 1e-15 / std::max(thinness, 1e-300);
  return longest * std::min(thinness, lost);
}

SurfaceTolerance surfaceTolerance(const TriangleMesh& mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  // Far from the origin, the corners of cut pieces are rounded to 1e-16 of their coordinates.
  const double reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  const double size = std::max(box.sizes().maxCoeff(), 1e-4 * reach);
  return {1e-10 * size, 1e-9 * size, 1e-14 * size, 1e-7 * size};
}

bool hasCertainPlane(const TriangleMesh& mesh, int triangle, const SurfaceTolerance& tolerance) {
  const double longest = longestEdge(cornersOf(mesh, triangle));
  const double height = areaNormal(mesh, triangle).norm() / std::max(longest, 1e-300);
  return height > 1e-6 * longest && height > tolerance.border;
}

TriangleCuts triangleCuts(const TriangleMesh& mesh, const TriangleTree& tree, const SurfaceTolerance& tolerance,
                          std::size_t max_pairs) {
  const double eps = tolerance.layer;
  TriangleCuts cuts;
  cuts.of.resize(mesh.triangles.size());
  std::vector<Measured> measured(mesh.triangles.size());
  parallelFor(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    const Corners c = cornersOf(mesh, triangle);
    measured[i] = {areaNormal(mesh, triangle).normalized(), closestError(c[0], c[1], c[2]),
                   hasCertainPlane(mesh, triangle, tolerance)};
  });
  std::atomic<std::size_t> pairs{0};
  tbb::enumerable_thread_specific<std::vector<int>> near_of_thread;
  parallelFor(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    if (!measured[i].certain) return;
    const Corners c = cornersOf(mesh, triangle);
    const Vector3d center = (c[0] + c[1] + c[2]) / 3.0;
    const double radius = std::max({(c[0] - center).norm(), (c[1] - center).norm(), (c[2] - center).norm()});
    std::vector<int>& near = near_of_thread.local();
    tree.trianglesWithin(center, radius + eps + tolerance.closest, near);
    for (const int other : near) {
      if (other == triangle || !cut(mesh, measured, triangle, other, eps)) continue;
      cuts.of[i].push_back(other);
      if (++pairs > max_pairs) break;
    }
    std::sort(cuts.of[i].begin(), cuts.of[i].end());
  });
  cuts.pairs = pairs;
  cuts.complete = pairs <= max_pairs;
  return cuts;
}

}  // namespace sdf_ccd
