#pragma once

#include <algorithm>

#include "sdf_ccd/common/eigen_types.h"

/// Whether the numbers of a grid's shape, which may come from a file, are those of a grid that may be.
namespace sdf_ccd {

inline bool isSurfaceBox(const AlignedBox3d& box) {
  return box.min().allFinite() && box.max().allFinite() && (box.min().array() <= box.max().array()).all();
}

/// Whether a grid's box has finite corners between which coordinates tell its smallest cells apart.
inline bool isPlace(const AlignedBox3d& box, double smallest_cell) {
  constexpr double kMostCells = 4e15;
  if (!isSurfaceBox(box)) return false;
  return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()) < kMostCells * smallest_cell;
}

}  // namespace sdf_ccd
