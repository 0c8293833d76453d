#include "cut_lists.h"

#include <algorithm>
#include <atomic>

#include <tbb/enumerable_thread_specific.h>

#include "common/parallel_for.h"
#include "cut_test.h"

namespace sdf_ccd {
namespace {

/// Data of a triangle for all tests against others, measured once.
struct Measured {
  AlignedBox3d box;
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
  const double apart = tolerance + a.error + b.error;
  // Twice, for rounding. Of the triangles near a long one most are beside it.
  if (((a.box.min() - b.box.max()).cwiseMax(b.box.min() - a.box.max()).array() > 2.0 * apart).any()) return false;
  return meet({i, cornersOf(mesh, first), a.normal}, {j, cornersOf(mesh, second), b.normal}, apart);
}

}  // namespace

CutLists cutLists(const TriangleMesh& mesh, const TriangleTree& tree, const SurfaceTolerance& tolerance,
                  std::size_t max_pairs) {
  const double eps = tolerance.layer;
  CutLists cuts;
  cuts.of.resize(mesh.triangles.size());
  std::vector<Measured> measured(mesh.triangles.size());
  parallelFor(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    const Corners c = cornersOf(mesh, triangle);
    AlignedBox3d box;
    for (const Vector3d& corner : c) box.extend(corner);
    measured[i] = {box, areaNormal(c).normalized(), closestError(c), hasCertainPlane(mesh, triangle, tolerance)};
  });
  std::atomic<std::size_t> pairs{0};
  tbb::enumerable_thread_specific<std::vector<int>> near_of_thread;
  parallelFor(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    if (!measured[i].certain) return;
    std::vector<int>& near = near_of_thread.local();
    tree.trianglesNear(cornersOf(mesh, triangle), eps + tolerance.closest, near);
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
