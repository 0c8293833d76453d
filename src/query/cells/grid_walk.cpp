#include "grid_walk.h"

#include <algorithm>
#include <limits>

namespace sdf_ccd {

bool clipToBox(const Vector3d& start, const Vector3d& step, const Vector3d& size, double& t0, double& t1) {
  for (int k = 0; k < 3; ++k) {
    if (step[k] == 0.0) {
      if (start[k] < 0.0 || start[k] > size[k]) return false;
      continue;
    }
    const double at_low = -start[k] / step[k], at_high = (size[k] - start[k]) / step[k];
    t0 = std::max(t0, std::min(at_low, at_high));
    t1 = std::min(t1, std::max(at_low, at_high));
  }
  return t0 <= t1;
}

GridWalk::GridWalk(const CellLattice& lattice, const Segment& segment)
    : lattice_(lattice),
      start_((segment.start - lattice.origin) / lattice.cell),
      step_((segment.end - segment.start) / lattice.cell) {
  // The inverse of the smallest steps is not finite; planes that they do not reach are infinitely far.
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (int k = 0; k < 3; ++k) per_step_[k] = std::clamp(1.0 / step_[k], -kLargest, kLargest);
  if (!clipToBox(start_, step_, lattice_.size.cast<double>(), t_, t_end_)) return;
  findCell();
  inside_ = true;
}

void GridWalk::advance() {
  t_ = t_exit_;
  if (axis_ < 0) {
    inside_ = false;
    return;
  }
  for (int k = 0; k < 3; ++k) {
    if (k == axis_ || step_[k] == 0.0) continue;
    const int at = cellAt(k, low_[k], high_[k] - 1);
    cell_[k] = step_[k] > 0.0 ? std::max(cell_[k], at) : std::min(cell_[k], at);
  }
  cell_[axis_] = step_[axis_] > 0.0 ? high_[axis_] : low_[axis_] - 1;
  inside_ = cell_[axis_] >= 0 && cell_[axis_] < lattice_.size[axis_];
}

}  // namespace sdf_ccd
