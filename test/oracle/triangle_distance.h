#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "sdf_ccd/mesh.h"

/// Distances of triangles by brute force, in long double.
namespace sdf_ccd::test {

using Real = long double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Triangle3r = std::array<Vector3r, 3>;

/// The corners in frame A of a triangle given in frame B.
inline Triangle3r exact(const std::array<Vector3d, 3>& corners_B, const Isometry3d& X_AB = Isometry3d::Identity()) {
  Triangle3r corners_A;
  for (int k = 0; k < 3; ++k)
    corners_A[k] = X_AB.linear().cast<Real>() * corners_B[k].cast<Real>() + X_AB.translation().cast<Real>();
  return corners_A;
}

inline Real segmentDistance2(const Vector3r& a, const Vector3r& b, const Vector3r& c, const Vector3r& d) {
  const Vector3r u = b - a, v = d - c, w = a - c;
  const Real uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), determinant = uu * vv - uv * uv;
  Real best = std::numeric_limits<Real>::infinity();
  const auto offer = [&](Real s, Real t) {
    s = std::clamp<Real>(s, 0, 1);
    t = std::clamp<Real>(t, 0, 1);
    best = std::min(best, (w + s * u - t * v).squaredNorm());
  };
  for (const Real s : {Real(0), Real(1)}) offer(s, vv > 0 ? v.dot(w + s * u) / vv : 0);
  for (const Real t : {Real(0), Real(1)}) offer(uu > 0 ? u.dot(t * v - w) / uu : 0, t);
  if (determinant > 0)
    offer((uv * v.dot(w) - vv * u.dot(w)) / determinant, (uu * v.dot(w) - uv * u.dot(w)) / determinant);
  return best;
}

/// Squared distance of p from a triangle whose closest point is in its interior; else infinity, as an edge is nearer.
inline Real faceDistance2(const Triangle3r& t, const Vector3r& p) {
  const Vector3r n = (t[1] - t[0]).cross(t[2] - t[0]);
  if (!(n.squaredNorm() > 0)) return std::numeric_limits<Real>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (n.cross(t[(k + 1) % 3] - t[k]).dot(p - t[k]) < 0) return std::numeric_limits<Real>::infinity();
  }
  const Real height = n.dot(p - t[0]);
  return height * height / n.squaredNorm();
}

/// Whether the segment pq passes through the triangle.
inline bool pierces(const Triangle3r& t, const Vector3r& p, const Vector3r& q) {
  const Vector3r n = (t[1] - t[0]).cross(t[2] - t[0]);
  const Real at_p = n.dot(p - t[0]), at_q = n.dot(q - t[0]);
  if (at_p * at_q > 0 || at_p == at_q) return false;
  return faceDistance2(t, p + at_p / (at_p - at_q) * (q - p)) < std::numeric_limits<Real>::infinity();
}

inline Real triangleDistance(const Triangle3r& a, const Triangle3r& b) {
  Real best = std::numeric_limits<Real>::infinity();
  for (int i = 0; i < 3; ++i) {
    best = std::min({best, faceDistance2(a, b[i]), faceDistance2(b, a[i])});
    if (pierces(a, b[i], b[(i + 1) % 3]) || pierces(b, a[i], a[(i + 1) % 3])) return 0;
    for (int k = 0; k < 3; ++k) {
      best = std::min(best, segmentDistance2(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
    }
  }
  return std::sqrt(best);
}

/// The smallest distance between triangles of two meshes, the second one displaced.
inline Real meshDistance(const TriangleMesh& a, const TriangleMesh& b, const Vector3d& displacement) {
  const auto corners = [](const TriangleMesh& mesh, const Vector3i& t, const Vector3d& by) {
    Triangle3r result;
    for (int k = 0; k < 3; ++k) result[k] = mesh.vertices[t[k]].cast<Real>() + by.cast<Real>();
    return result;
  };
  Real best = std::numeric_limits<Real>::infinity();
  for (const Vector3i& i : a.triangles) {
    const Triangle3r t = corners(a, i, Vector3d::Zero());
    const Vector3r center = (t[0] + t[1] + t[2]) / 3;
    const Real radius = std::max({(t[0] - center).norm(), (t[1] - center).norm(), (t[2] - center).norm()});
    for (const Vector3i& k : b.triangles) {
      const Triangle3r u = corners(b, k, displacement);
      const Vector3r other = (u[0] + u[1] + u[2]) / 3;
      const Real reach = std::max({(u[0] - other).norm(), (u[1] - other).norm(), (u[2] - other).norm()});
      if ((center - other).norm() - radius - reach >= best) continue;
      best = std::min(best, triangleDistance(t, u));
    }
  }
  return best;
}

}  // namespace sdf_ccd::test
