#include "self_crossing.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <tbb/enumerable_thread_specific.h>

#include "common/parallel_for.h"
#include "cut_test.h"
#include "mesh/mesh_edges.h"

namespace sdf_ccd {
namespace {

/// Where the segment passes through the triangle.
std::optional<Vector3d> piercing(const Vector3d& a, const Vector3d& b, const Corners& t) {
  const Vector3d normal = areaNormal(t);
  const double at_a = normal.dot(a - t[0]), at_b = normal.dot(b - t[0]);
  if (at_a == at_b || at_a * at_b > 0.0) return std::nullopt;
  const Vector3d p = a + at_a / (at_a - at_b) * (b - a);
  for (int k = 0; k < 3; ++k) {
    if ((t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(normal) < 0.0) return std::nullopt;
  }
  return p;
}

/// The middle of the segment in which two triangles cross, if they do.
std::optional<Vector3d> middleOfCrossing(const Corners& i, const Corners& j) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    for (const auto& p : {piercing(i[k], i[(k + 1) % 3], j), piercing(j[k], j[(k + 1) % 3], i)}) {
      if (!p) continue;
      sum += *p;
      ++count;
    }
  }
  if (count < 2) return std::nullopt;
  return sum / count;
}

/// Looks at the four points at a distance `step` [m] from both planes beside the crossing of two triangles. @return
/// whether all of them with winding number zero see the outside.
bool allSeen(const TriangleMesh& mesh, const TriangleTree& tree, int first, int second, double step) {
  constexpr double kFlat = 1e-4;
  const Vector3d n = areaNormal(mesh, first).normalized(), m = areaNormal(mesh, second).normalized();
  const double cosine = n.dot(m), squared_sine = n.cross(m).squaredNorm();
  if (!(squared_sine > kFlat)) return false;
  const std::optional<Vector3d> middle = middleOfCrossing(cornersOf(mesh, first), cornersOf(mesh, second));
  if (!middle) return true;  // they meet in a point only, where other triangles cross, too
  for (const double s : {-step, step}) {
    for (const double t : {-step, step}) {
      // n·d = s, m·d = t
      const Vector3d d = ((s - cosine * t) * n + (t - cosine * s) * m) / squared_sine;
      const Vector3d p = *middle + d;
      if (std::lround(tree.windingNumber(p)) == 0 && !tree.seesOutside(p)) return false;
    }
  }
  return true;
}

}  // namespace

bool branches(const TriangleMesh& mesh) {
  bool found = false;
  forEachEdge(edgeUses(mesh), [&](const EdgeUse* first, const EdgeUse* last) { found = found || last - first > 2; });
  return found;
}

bool mayHidePockets(const TriangleMesh& mesh, const TriangleTree& tree) {
  const double step = 1e-5 * boundingBox(mesh).sizes().maxCoeff(), eps = cutTolerance(mesh);
  std::atomic<bool> found{false};
  tbb::enumerable_thread_specific<std::vector<int>> near_of_thread;
  parallelFor(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    if (found) return;
    const int triangle = static_cast<int>(i);
    std::vector<int>& near = near_of_thread.local();
    tree.trianglesNear(cornersOf(mesh, triangle), eps, near);
    for (const int other : near) {
      if (other <= triangle || !cut(mesh, triangle, other, eps)) continue;
      if (!allSeen(mesh, tree, triangle, other, step)) found = true;
    }
  });
  return found;
}

}  // namespace sdf_ccd
