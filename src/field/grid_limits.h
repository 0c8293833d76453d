#pragma once

#include <algorithm>

#include "sdf_ccd/types.h"

/// Checks that the numbers of a grid's shape, which may come from a file, are plausible.
namespace sdf_ccd {

inline bool isSurfaceBox(const AlignedBox3d& box) {
  return box.min().allFinite() && box.max().allFinite() && (box.min().array() <= box.max().array()).all();
}

/// Whether a surface's box is valid and lies in the grid's, beyond which the grid tells nothing of the surface.
inline bool isSurfaceBox(const AlignedBox3d& box, const AlignedBox3d& grid_box) {
  return isSurfaceBox(box) && grid_box.contains(box);
}

/// Whether a grid's box has finite corners, in a range where coordinates resolve its smallest cells.
inline bool canResolve(const AlignedBox3d& box, double smallest_cell) {
  constexpr double kMaxCells = 4e15;
  if (!isSurfaceBox(box)) return false;
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) < kMaxCells * smallest_cell;
}

}  // namespace sdf_ccd
