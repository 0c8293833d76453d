#pragma once

#include <cmath>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd::test {

/// Winding number of a mesh at p by its definition, in extended precision: the solid angles of all triangles, each by
/// its own arc tangent (Van Oosterom & Strackee 1983, Eq. 8), over 4π.
inline double windingNumber(const TriangleMesh& mesh, const Vector3d& p) {
  using Vector = Eigen::Matrix<long double, 3, 1>;
  long double sum = 0;
  for (const Vector3i& t : mesh.triangles) {
    const auto from = [&](int corner) -> Vector { return (mesh.vertices[corner] - p).cast<long double>(); };
    const Vector a = from(t[0]), b = from(t[1]), c = from(t[2]);
    const long double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<double>(sum / (2 * std::acos(-1.0L)));
}

}  // namespace sdf_ccd::test
