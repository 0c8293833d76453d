#pragma once

#include <cmath>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// The cell of a grid, of `count` cells per axis, in which a point lies, or the nearest one to it. @param g  in cells.
inline Vector3i cellAt(const Vector3d& g, const Vector3i& count) {
  return g.cwiseMax(0.0).cast<int>().cwiseMin((count.array() - 1).max(0).matrix());
}

/// Coordinates in a cell, of which rounding may have left [0, 1]³.
inline Vector3d withinCell(const Vector3d& u) {
  return u.array().max(0.0).min(1.0);
}

/// Half the diagonal of a unit cube. Also the maximum error, in sides of the cell, of the trilinear interpolation of
/// exact corner values of a 1-Lipschitz function (lipschitzError() at the centre).
constexpr double kHalfSqrt3 = 0.8660254037844386;

/// Bound on |trilinear − f| for exact corner values of a 1-Lipschitz f on a cube of side h [m] (design §3.3).
inline double lipschitzError(const Vector3d& u, double h) {
  return h * std::sqrt((u.array() * (1.0 - u.array())).max(0.0).sum());
}

}  // namespace sdf_ccd
