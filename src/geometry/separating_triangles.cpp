#include "sdf_ccd/geometry/separating_triangles.h"

#include <algorithm>
#include <array>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "mesh_edges.h"
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

/// Whether the segment meets the triangle, to a distance `eps`.
bool meets(const Corners& t, const Vector3d& a, const Vector3d& b, double eps) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
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

bool onOneSide(const Corners& t, const Corners& of, double eps) {
  const Vector3d normal = (of[1] - of[0]).cross(of[2] - of[0]).normalized();
  double low = eps, high = -eps;
  for (const Vector3d& corner : t) {
    const double s = normal.dot(corner - of[0]);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return low >= eps || high <= -eps;
}

/// Whether two triangles of a mesh cut or overlap each other elsewhere than at vertices and edges they share.
bool cut(const TriangleMesh& mesh, int first, int second, double eps) {
  const Vector3i &i = mesh.triangles[first], &j = mesh.triangles[second];
  const Corners a = cornersOf(mesh, first), b = cornersOf(mesh, second);
  int shared = 0, alone_i = 0, alone_j = 0;  // corners; and, of triangles that share one, which
  for (int k = 0; k < 3; ++k) {
    const bool in_j = i[k] == j[0] || i[k] == j[1] || i[k] == j[2];
    shared += in_j;
    if (in_j) alone_i = k;
    if (j[k] == i[0] || j[k] == i[1] || j[k] == i[2]) alone_j = k;
  }
  if (shared == 3) return true;
  if (shared == 2) return areaNormal(mesh, first).normalized().dot(areaNormal(mesh, second).normalized()) < -0.999999;
  if (shared == 1) {
    return meets(b, a[(alone_i + 1) % 3], a[(alone_i + 2) % 3], eps) ||
           meets(a, b[(alone_j + 1) % 3], b[(alone_j + 2) % 3], eps);
  }
  if (onOneSide(a, b, eps) || onOneSide(b, a, eps)) return false;
  for (int k = 0; k < 3; ++k) {
    if (meets(b, a[k], a[(k + 1) % 3], eps) || meets(a, b[k], b[(k + 1) % 3], eps)) return true;
  }
  return false;
}

/// For each triangle, whether the neighbours at all its edges agree with it about the outside.
std::vector<std::uint8_t> agreeWithNeighbours(const TriangleMesh& mesh, const std::vector<EdgeUse>& uses) {
  std::vector<std::uint8_t> agree(mesh.triangles.size(), 1);
  forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
    if (imbalance(first, last) == 0) return;
    for (; first != last; ++first) agree[first->triangle] = 0;
  });
  return agree;
}

/// Leaves those triangles that face the outside, as the winding number just before and behind them says.
class OutsideTest {
 public:
  OutsideTest(const TriangleMesh& mesh, const TriangleTree& tree) : mesh_(mesh), tree_(tree) {}

  bool passes(std::int32_t triangle, bool closed) const {
    const Corners c = cornersOf(mesh_, triangle);
    const Vector3d area_normal = areaNormal(mesh_, triangle), center = (c[0] + c[1] + c[2]) / 3.0;
    // Near enough that nothing else lies between, far enough for rounding.
    const Vector3d step = 1e-6 * area_normal / longestEdge(c);
    for (const Vector3d& towards : {center, c[0], c[1], c[2]}) {
      // Over a triangle that nothing cuts the winding number of a closed mesh is the same everywhere.
      if (closed && towards != center) break;
      const Vector3d p = center + 0.9 * (towards - center);
      if (tree_.windingNumber(p + step) > 0.5 || tree_.windingNumber(p - step) <= 0.5) return false;
    }
    return true;
  }

  void each(std::vector<std::uint8_t>& separates) const {
    tbb::parallel_for(std::size_t{0}, separates.size(), [&](std::size_t i) {
      if (separates[i] != 0) separates[i] = passes(static_cast<std::int32_t>(i), false);
    });
  }

  /// For closed meshes. Just before the surface nothing lies between triangles that share an edge with no third one and
  /// that nothing cuts: the winding number is the same there. So one of a connected set speaks for all.
  void eachPatch(const std::vector<EdgeUse>& uses, std::vector<std::uint8_t>& separates) const {
    TriangleSets sets(separates.size());
    forEachEdge(uses, [&](const EdgeUse* first, const EdgeUse* last) {
      const bool pair = last - first == 2 && separates[first[0].triangle] != 0 && separates[first[1].triangle] != 0;
      if (pair) sets.join(first[0].triangle, first[1].triangle);
    });
    const auto area = [&](std::int32_t i) { return areaNormal(mesh_, i).squaredNorm(); };
    std::vector<std::int32_t> largest(separates.size(), -1);  // of the set that a triangle names
    for (std::size_t i = 0; i < separates.size(); ++i) {
      if (separates[i] == 0) continue;
      const auto triangle = static_cast<std::int32_t>(i);
      std::int32_t& held = largest[sets.find(triangle)];
      if (held < 0 || area(triangle) > area(held)) held = triangle;
    }
    std::vector<std::uint8_t> passed(separates.size(), 0);
    tbb::parallel_for(std::size_t{0}, separates.size(), [&](std::size_t i) {
      if (largest[i] >= 0) passed[i] = passes(largest[i], true);
    });
    for (std::size_t i = 0; i < separates.size(); ++i) {
      if (separates[i] != 0) separates[i] = passed[sets.find(static_cast<std::int32_t>(i))];
    }
  }

 private:
  const TriangleMesh& mesh_;
  const TriangleTree& tree_;
};

}  // namespace

std::vector<std::uint8_t> separatingTriangles(const TriangleMesh& mesh, const TriangleTree& tree) {
  const AlignedBox3d box = boundingBox(mesh);
  const double size =
      std::max(box.sizes().maxCoeff(), 1e-6 * box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff());
  const double eps = 1e-12 * size;
  const std::vector<EdgeUse> uses = edgeUses(mesh);
  const std::vector<std::uint8_t> agrees = agreeWithNeighbours(mesh, uses);

  std::vector<std::uint8_t> separates(mesh.triangles.size(), 0);
  tbb::enumerable_thread_specific<std::vector<int>> near_of_thread;
  tbb::parallel_for(std::size_t{0}, mesh.triangles.size(), [&](std::size_t i) {
    const int triangle = static_cast<int>(i);
    const Corners c = cornersOf(mesh, triangle);
    const double longest = longestEdge(c);
    const double height = areaNormal(mesh, triangle).norm() / std::max(longest, 1e-300);
    if (!(height > 1e-6 * longest) || !(height > 10.0 * eps) || agrees[i] == 0) return;
    const Vector3d center = (c[0] + c[1] + c[2]) / 3.0;
    const double radius = std::max({(c[0] - center).norm(), (c[1] - center).norm(), (c[2] - center).norm()});
    std::vector<int>& near = near_of_thread.local();
    tree.trianglesWithin(center, radius + eps, near);
    for (const int other : near) {
      if (other != triangle && cut(mesh, triangle, other, eps)) return;
    }
    separates[i] = 1;
  });
  const OutsideTest outside(mesh, tree);
  if (isClosed(mesh)) {
    outside.eachPatch(uses, separates);
  } else {
    outside.each(separates);
  }
  return separates;
}

}  // namespace sdf_ccd
