#pragma once

#include <algorithm>

#include "sdf_ccd/segments.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A lattice of cubic cells.
struct CellLattice {
  Vector3d origin;  ///< first corner of the first cell [m]
  double cell;      ///< [m]
  Vector3i size;    ///< cells per axis
};

/// The part of a line start + t·step, t in [t0, t1], that lies in the box from the origin to `size`: shortens the
/// interval. @return false if no part of it does.
bool clipToBox(const Vector3d& start, const Vector3d& step, const Vector3d& size, double& t0, double& t1);

/// Follows a segment through the cells of a grid, block by block.
///
/// The parameter comes from the plane that is crossed, never from a sum of steps, and the crossed plane's cell index
/// is set, not computed: so no cell is visited twice and none is skipped, even if the segment runs along faces.
class GridWalk {
 public:
  GridWalk(const CellLattice& lattice, const Segment& segment);

  /// False once the segment has ended or left the grid (or if it never enters it).
  bool inside() const { return inside_; }

  const CellLattice& lattice() const { return lattice_; }

  const Vector3i& cell() const { return cell_; }

  /// Parameter at which the current block was entered.
  double t() const { return t_; }

  /// Parameter at which the segment ends or leaves the grid.
  double end() const { return t_end_; }

  /// Parameter at which the segment leaves the block of cells [low, high) around the current cell, at most its end;
  /// stores the face.
  double exit(const Vector3i& low, const Vector3i& high) {
    low_ = low;
    high_ = high;
    axis_ = -1;
    t_exit_ = t_end_;
    for (int k = 0; k < 3; ++k) {
      if (step_[k] == 0.0) continue;
      const double t = ((step_[k] > 0.0 ? high[k] : low[k]) - start_[k]) * per_step_[k];
      if (t < t_exit_) {
        t_exit_ = t;
        axis_ = k;
      }
    }
    t_exit_ = std::max(t_exit_, t_);
    return t_exit_;
  }

  /// Steps through the face that exit() found.
  void advance();

  /// Advances to t, which is not before the current block's exit() and at most the segment's end.
  void skipTo(double t) {
    inside_ = t < t_end_;
    t_ = std::min(t, t_end_);
    findCell();
  }

  /// The segment's point at t, in cells from `origin_cell`'s first corner.
  Vector3d local(double t, const Vector3i& origin_cell) const {
    return start_ + t * step_ - origin_cell.cast<double>();
  }

 private:
  /// The cell along axis k at the current parameter, clamped to [low, high].
  int cellAt(int k, double low, double high) const {
    return static_cast<int>(std::min(std::max(start_[k] + t_ * step_[k], low), high));
  }

  void findCell() {
    for (int k = 0; k < 3; ++k) cell_[k] = cellAt(k, 0.0, lattice_.size[k] - 1);
  }

  CellLattice lattice_;
  Vector3d start_, step_;  // in cells
  Vector3d per_step_;      // 1 / step, where that is not zero
  Vector3i cell_ = Vector3i::Zero();
  double t_ = 0.0, t_end_ = 1.0;
  bool inside_ = false;
  // results of exit()
  Vector3i low_ = Vector3i::Zero(), high_ = Vector3i::Zero();
  double t_exit_ = 0.0;
  int axis_ = -1;
};

}  // namespace sdf_ccd
