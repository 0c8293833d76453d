#include "triangle_cuts.h"

#include <algorithm>
#include <array>
#include <atomic>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "sdf_ccd/geometry/triangle.h"

namespace sdf_ccd {
namespace {

using Corners = std::array<Vector3d, 3>;

Corners cornersOf(const TriangleMesh& mesh, int triangle) {
  const Vector3i& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

double longestEdge(const Corners& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

double distanceToTriangle(const Corners& t, const Vector3d& p) {
  return (closestOnTriangle(t[0], t[1], t[2], p) - p).norm();
}

/// Squared distance of two segments (Ericson 2005, §5.1.9, by the four ends and the crossing of the lines).
double squaredDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  double best =
      std::min({(closestOnSegment(a, b, c) - c).squaredNorm(), (closestOnSegment(a, b, d) - d).squaredNorm(),
                (closestOnSegment(c, d, a) - a).squaredNorm(), (closestOnSegment(c, d, b) - b).squaredNorm()});
  const Vector3d u = b - a, v = d - c, w = a - c;
  const double uu = u.squaredNorm(), uv = u.dot(v), vv = v.squaredNorm(), determinant = uu * vv - uv * uv;
  if (determinant > 0.0) {
    const double s = (uv * v.dot(w) - vv * u.dot(w)) / determinant, t = (uu * v.dot(w) - uv * u.dot(w)) / determinant;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0) best = std::min(best, (w + s * u - t * v).squaredNorm());
  }
  return best;
}

/// What all tests of a triangle against others need, measured once.
struct Measured {
  Vector3d normal;  ///< of length one, or zero
  double error;     ///< see closestError()
  bool certain;     ///< see hasCertainPlane()
};

/// Whether the segment meets the triangle, to a distance `eps`.
bool meets(const Corners& t, const Vector3d& normal, const Vector3d& a, const Vector3d& b, double eps) {
  const double at_a = normal.dot(a - t[0]), at_b = normal.dot(b - t[0]);
  if (std::min(at_a, at_b) > eps || std::max(at_a, at_b) < -eps) return false;
  if (distanceToTriangle(t, a) <= eps || distanceToTriangle(t, b) <= eps) return true;
  if (at_a != at_b) {
    const double s = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    if (distanceToTriangle(t, a + s * (b - a)) <= eps) return true;
  }
  for (int k = 0; k < 3; ++k) {
    if (squaredDistance(a, b, t[k], t[(k + 1) % 3]) <= eps * eps) return true;
  }
  return false;
}

bool onOneSide(const Corners& t, const Corners& of, const Vector3d& normal, double eps) {
  double low = eps, high = -eps;
  for (const Vector3d& corner : t) {
    const double s = normal.dot(corner - of[0]);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return low >= eps || high <= -eps;
}

/// Whether two triangles of a mesh cut or overlap each other elsewhere than at vertices and edges they share.
bool cut(const TriangleMesh& mesh, const std::vector<Measured>& measured, int first, int second, double tolerance) {
  const Vector3i &i = mesh.triangles[first], &j = mesh.triangles[second];
  int shared = 0, alone_i = 0, alone_j = 0;  // corners; and, of triangles that share one, which
  for (int k = 0; k < 3; ++k) {
    const bool in_j = i[k] == j[0] || i[k] == j[1] || i[k] == j[2];
    shared += in_j;
    if (in_j) alone_i = k;
    if (j[k] == i[0] || j[k] == i[1] || j[k] == i[2]) alone_j = k;
  }
  if (shared == 3) return true;
  const Vector3d &normal_a = measured[first].normal, &normal_b = measured[second].normal;
  if (shared == 2) return normal_a.dot(normal_b) < -0.999999;
  const Corners a = cornersOf(mesh, first), b = cornersOf(mesh, second);
  const double eps = tolerance + measured[first].error + measured[second].error;
  if (shared == 1) {
    return meets(b, normal_b, a[(alone_i + 1) % 3], a[(alone_i + 2) % 3], eps) ||
           meets(a, normal_a, b[(alone_j + 1) % 3], b[(alone_j + 2) % 3], eps);
  }
  if (onOneSide(a, b, normal_b, eps) || onOneSide(b, a, normal_a, eps)) return false;
  for (int k = 0; k < 3; ++k) {
    if (meets(b, normal_b, a[k], a[(k + 1) % 3], eps) || meets(a, normal_a, b[k], b[(k + 1) % 3], eps)) return true;
  }
  return false;
}

}  // namespace

double closestError(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double longest = longestEdge({a, b, c});
  if (!(longest > 0.0)) return 0.0;
  const double thinness = (b - a).cross(c - a).norm() / (longest * longest);
  // Below this, closest points are looked for on the edges too, and the interior's lose fewer digits.
  constexpr double kSliver = 1e-4;
  const double lost = thinness > kSliver ? 4e-16 / (thinness * thinness) : 1e-15 / std::max(thinness, 1e-300);
  return longest * std::min(thinness, lost);
}

SurfaceTolerance surfaceTolerance(const TriangleMesh& mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  // Far from the origin, what is cut off a triangle has corners rounded to 1e-16 of their coordinates.
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
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    const Corners c = cornersOf(mesh, triangle);
    measured[i] = {areaNormal(mesh, triangle).normalized(), closestError(c[0], c[1], c[2]),
                   hasCertainPlane(mesh, triangle, tolerance)};
  });
  std::atomic<std::size_t> pairs{0};
  tbb::enumerable_thread_specific<std::vector<int>> near_of_thread;
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
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
