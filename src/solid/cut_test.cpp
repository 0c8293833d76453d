#include "cut_test.h"

#include <algorithm>

#include "mesh/box_measures.h"
#include "mesh/triangle.h"

namespace sdf_ccd {
namespace {

double distanceToTriangle(const Corners& t, const Vector3d& p) {
  return (closestOnTriangle(t, p) - p).norm();
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

/// Whether the segment meets the triangle, within a distance `eps`.
bool meets(const FacedTriangle& triangle, const Vector3d& a, const Vector3d& b, double eps) {
  const Corners& t = triangle.corners;
  const Vector3d& normal = triangle.normal;
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

bool onOneSide(const FacedTriangle& t, const FacedTriangle& of, double eps) {
  double low = eps, high = -eps;
  for (const Vector3d& corner : t.corners) {
    const double s = of.normal.dot(corner - of.corners[0]);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return low >= eps || high <= -eps;
}

/// Whether two triangles with a common edge lie on the same side of it, nearly flat on each other.
bool folded(const TriangleMesh& mesh, const Vector3i& i, const Vector3i& j) {
  int apex_i = 0, apex_j = 0;
  for (int k = 0; k < 3; ++k) {
    if ((j.array() != i[k]).all()) apex_i = k;
    if ((i.array() != j[k]).all()) apex_j = k;
  }
  const Vector3d& base = mesh.vertices[i[(apex_i + 1) % 3]];
  const Vector3d edge = mesh.vertices[i[(apex_i + 2) % 3]] - base;
  const auto height = [&](int apex) { return edge.cross(mesh.vertices[apex] - base).normalized(); };
  return height(i[apex_i]).dot(height(j[apex_j])) > 0.999999;
}

FacedTriangle faced(const TriangleMesh& mesh, int triangle) {
  return {mesh.triangles[triangle], cornersOf(mesh, triangle), areaNormal(mesh, triangle).normalized()};
}

/// The first corner that the other triangle has too.
int commonCorner(const Vector3i& of, const Vector3i& with) {
  for (int k = 0; k < 3; ++k) {
    if ((with.array() == of[k]).any()) return k;
  }
  return 0;
}

}  // namespace

double cutTolerance(const TriangleMesh& mesh) {
  const AlignedBox3d box = boundingBox(mesh);
  return 1e-12 * std::max(box.sizes().maxCoeff(), 1e-6 * largestCoordinate(box));
}

int sharedVertices(const Vector3i& a, const Vector3i& b) {
  int shared = 0;
  for (int k = 0; k < 3; ++k) shared += (b.array() == a[k]).any();
  return shared;
}

bool meet(const FacedTriangle& a, const FacedTriangle& b, double eps) {
  if (sharedVertices(a.vertices, b.vertices) == 1) {
    // Elsewhere than at the common vertex they meet if the opposite side of one meets the other.
    const int at_a = commonCorner(a.vertices, b.vertices), at_b = commonCorner(b.vertices, a.vertices);
    return meets(b, a.corners[(at_a + 1) % 3], a.corners[(at_a + 2) % 3], eps) ||
           meets(a, b.corners[(at_b + 1) % 3], b.corners[(at_b + 2) % 3], eps);
  }
  if (onOneSide(a, b, eps) || onOneSide(b, a, eps)) return false;
  for (int k = 0; k < 3; ++k) {
    if (meets(b, a.corners[k], a.corners[(k + 1) % 3], eps) || meets(a, b.corners[k], b.corners[(k + 1) % 3], eps)) {
      return true;
    }
  }
  return false;
}

bool cut(const TriangleMesh& mesh, int first, int second, double eps) {
  const Vector3i &i = mesh.triangles[first], &j = mesh.triangles[second];
  const int shared = sharedVertices(i, j);
  if (shared == 3) return true;
  if (shared == 2) return folded(mesh, i, j);
  return meet(faced(mesh, first), faced(mesh, second), eps);
}

}  // namespace sdf_ccd
