#pragma once

#include <vector>

#include <Eigen/Core>

#include "sdf_ccd/mesh.h"

/// Whether bodies with integer coordinates meet while one slides along a straight path, computed without rounding.
namespace sdf_ccd::test {

using Whole = __int128;
using Vector3w = Eigen::Matrix<Whole, 3, 1>;

/// A convex polytope; the magnitudes of coordinates are below 2^20, so that nothing overflows.
struct WholeConvex {
  std::vector<Vector3w> corners;
  std::vector<Vector3w> normals;  ///< of its faces; one of two opposite normals
  std::vector<Vector3w> edges;
};

enum class Sweep { kApart, kTouch, kOverlap };

inline Vector3w cross(const Vector3w& a, const Vector3w& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// From a convex mesh whose coordinates are integer multiples of `unit`.
inline WholeConvex wholeConvexOf(const TriangleMesh& mesh, double unit) {
  WholeConvex convex;
  for (const Vector3d& v : mesh.vertices) {
    const Vector3d steps = v / unit;
    convex.corners.emplace_back(Whole(steps.x()), Whole(steps.y()), Whole(steps.z()));
  }
  const auto add = [](const Vector3w& v, std::vector<Vector3w>& directions) {
    for (const Vector3w& d : directions)
      if (cross(d, v) == Vector3w(0, 0, 0)) return;
    directions.push_back(v);
  };
  for (const Vector3i& t : mesh.triangles) {
    const auto& v = convex.corners;
    add(cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]), convex.normals);
    for (int k = 0; k < 3; ++k) add(v[t[(k + 1) % 3]] - v[t[k]], convex.edges);
  }
  return convex;
}

/// Rotated by an integer matrix, then translated.
inline WholeConvex moved(const WholeConvex& convex, const Eigen::Matrix<Whole, 3, 3>& R, const Vector3w& by) {
  WholeConvex result = convex;
  for (Vector3w& p : result.corners) p = R * p + by;
  for (Vector3w& n : result.normals) n = R * n;
  for (Vector3w& e : result.edges) e = R * e;
  return result;
}

/// Tests A against B, which slides along `path`. The volume that B sweeps is convex, and each of its faces is one of
/// B's or contains an edge of B and the path's direction: so only these axes, A's normals and the cross products of
/// edges can separate it from A.
inline Sweep sweep(const WholeConvex& a, const WholeConvex& b, const Vector3w& path) {
  Sweep best = Sweep::kOverlap;
  const auto look = [&](const Vector3w& axis) {
    if (best == Sweep::kApart || axis == Vector3w(0, 0, 0)) return;
    Whole low_a = axis.dot(a.corners[0]), high_a = low_a, low_b = axis.dot(b.corners[0]), high_b = low_b;
    for (const Vector3w& p : a.corners) {
      low_a = std::min(low_a, axis.dot(p));
      high_a = std::max(high_a, axis.dot(p));
    }
    for (const Vector3w& p : b.corners) {
      low_b = std::min(low_b, axis.dot(p));
      high_b = std::max(high_b, axis.dot(p));
    }
    const Whole along = axis.dot(path);
    (along > 0 ? high_b : low_b) += along;
    const Whole gap = std::max(low_b - high_a, low_a - high_b);
    if (gap > 0) best = Sweep::kApart;
    if (gap == 0 && best == Sweep::kOverlap) best = Sweep::kTouch;
  };
  for (const Vector3w& n : a.normals) look(n);
  for (const Vector3w& n : b.normals) look(n);
  for (const Vector3w& d : a.edges) look(cross(d, path));
  for (const Vector3w& e : b.edges) look(cross(e, path));
  for (const Vector3w& d : a.edges)
    for (const Vector3w& e : b.edges) look(cross(d, e));
  return best;
}

}  // namespace sdf_ccd::test
