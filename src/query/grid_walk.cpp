#include "grid_walk.h"

#include <algorithm>
#include <cmath>

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
    : size_(lattice.size),
      start_((segment.start - lattice.origin) / lattice.cell),
      step_((segment.end - segment.start) / lattice.cell) {
  if (!clipToBox(start_, step_, size_.cast<double>(), t_, t_end_)) return;
  findCell();
  inside_ = true;
}

void GridWalk::findCell() {
  for (int k = 0; k < 3; ++k) {
    cell_[k] = static_cast<int>(std::clamp(std::floor(start_[k] + t_ * step_[k]), 0.0, double(size_[k] - 1)));
  }
}

double GridWalk::exit(const Vector3i& low, const Vector3i& high) {
  low_ = low;
  high_ = high;
  axis_ = -1;
  t_exit_ = t_end_;
  for (int k = 0; k < 3; ++k) {
    if (step_[k] == 0.0) continue;
    const double plane = step_[k] > 0.0 ? high[k] : low[k];
    const double t = (plane - start_[k]) / step_[k];
    if (t < t_exit_) {
      t_exit_ = t;
      axis_ = k;
    }
  }
  t_exit_ = std::max(t_exit_, t_);
  return t_exit_;
}

void GridWalk::skipTo(double t) {
  inside_ = t < t_end_;
  t_ = std::min(t, t_end_);
  findCell();
}

void GridWalk::advance() {
  t_ = t_exit_;
  if (axis_ < 0) {
    inside_ = false;
    return;
  }
  for (int k = 0; k < 3; ++k) {
    if (k == axis_ || step_[k] == 0.0) continue;
    const int at =
        static_cast<int>(std::clamp(std::floor(start_[k] + t_ * step_[k]), double(low_[k]), double(high_[k] - 1)));
    cell_[k] = step_[k] > 0.0 ? std::max(cell_[k], at) : std::min(cell_[k], at);
  }
  cell_[axis_] = step_[axis_] > 0.0 ? high_[axis_] : low_[axis_] - 1;
  inside_ = cell_[axis_] >= 0 && cell_[axis_] < size_[axis_];
}

}  // namespace sdf_ccd
