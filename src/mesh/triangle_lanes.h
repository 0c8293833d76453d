#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/triangle.h"

namespace sdf_ccd {

/// A triangle in its own frame: corners at (0, 0), (b, 0) and (c, height). For closest points of eight query points at
/// once, without branches, so that the compiler generates vector code. Not for slivers, for which the frame is too
/// inaccurate.
struct FlatTriangle {
  FlatTriangle() = default;
  explicit FlatTriangle(const Corners& corners);

  std::array<double, 3> origin, u, v, normal;  ///< of the frame: u along the first edge, of length one
  double b, c, height;
  double inverse_bc2, inverse_ca2;  ///< of the edges' squared lengths [1/m²]
};

/// Eight query points.
struct PointLanes {
  static constexpr int kCount = 8;
  using Lane = std::array<double, kCount>;
  alignas(64) Lane x, y, z;

  void set(int k, const Vector3d& p) {
    x[k] = p.x();
    y[k] = p.y();
    z[k] = p.z();
  }
  Vector3d at(int k) const { return {x[k], y[k], z[k]}; }
  void copy(int from, int to) {
    x[to] = x[from];
    y[to] = y[from];
    z[to] = z[from];
  }
};

/// For each of eight query points, the closest point on several triangles.
struct ClosestLanes {
  alignas(64) PointLanes::Lane distance2;  ///< [m²]
  alignas(64) PointLanes::Lane side;       ///< displacement from the closest point, along the axis [m]
};

/// Displacements of eight query points from the triangle's closest points.
struct DisplacementLanes {
  alignas(64) PointLanes::Lane distance2;  ///< [m²]
  alignas(64) PointLanes::Lane x, y, z;    ///< from the closest point to the query point [m]

  Vector3d at(int k) const { return {x[k], y[k], z[k]}; }
};

/// Replaces the closest points held so far where the triangle is nearer.
void offer(const FlatTriangle& triangle, const Vector3d& axis, const PointLanes& points, ClosestLanes& closest);

void displacements(const FlatTriangle& triangle, const PointLanes& points, DisplacementLanes& found);

}  // namespace sdf_ccd
