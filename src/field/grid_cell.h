#pragma once

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// The cell of a grid, of `count` cells per axis, in which a point lies, or the nearest one to it. @param g  in cells.
inline Vector3i cellAt(const Vector3d& g, const Vector3i& count) {
  return g.array().floor().max(0.0).matrix().cast<int>().cwiseMin((count.array() - 1).max(0).matrix());
}

/// Coordinates in a cell, of which rounding may have left [0, 1]³.
inline Vector3d withinCell(const Vector3d& u) {
  return u.array().max(0.0).min(1.0);
}

}  // namespace sdf_ccd
