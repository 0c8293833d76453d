#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/lattice.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Signed distances from the points of a lattice to the boundary of voxels that fill whole cells of it: along each axis
/// voxel i fills the cells from n i to n (i + 1). Distances are in cells, and exact.
///
/// The squared distance from a lattice point to a set of cubes is the minimum over the cubes of the sum of the squared
/// distances along the three axes, so it can be computed one axis after the other (Felzenszwalb & Huttenlocher,
/// "Distance transforms of sampled functions", 2012).
class LatticeDistance {
 public:
  /// @param low, size    the lattice's first point, and the number of points along each axis.
  /// @param first, last  the window: the voxels considered. No point is farther than 140 cells from a voxel along an
  /// axis.
  /// @param is_in        whether a voxel is occupied.
  template <class IsIn>
  void compute(int cells_per_voxel, const Vector3i& low, const Vector3i& size, const Vector3i& first,
               const Vector3i& last, const IsIn& is_in);

  /// The distance at a point, given by its indices from the lattice's first point; negative in occupied voxels. Exact
  /// up to the distance that the window covers around the point; a larger value only says that the distance is larger.
  double at(const Vector3i& point) const {
    const std::size_t i = indexIn(size_, point);
    return outside_[i] > 0 ? std::sqrt(double(outside_[i])) : -std::sqrt(double(inside_[i]));
  }

 private:
  using Squared = std::uint16_t;
  static constexpr Squared kNone = 40000;  // more than any distance in a window; adding one more does not overflow

  void transform(bool to_occupied, std::vector<Squared>& squares);
  void alongX(const std::uint8_t* voxels, bool to_occupied, Squared* row);

  /// Squared distance from a lattice point to a voxel along an axis.
  Squared squared(int axis, int point, int voxel) const {
    const int p = low_[axis] + point, begin = n_ * (first_[axis] + voxel);
    const int away = std::max({0, begin - p, p - begin - n_});
    return static_cast<Squared>(away * away);
  }
  static void takeLeast(const Squared* from, std::size_t size, Squared more, Squared* to) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto sum = static_cast<Squared>(from[i] + more);
      to[i] = std::min(to[i], sum);
    }
  }

  int n_ = 1;
  Vector3i low_, size_, first_, count_;
  std::vector<std::uint8_t> voxels_;  // of the window, x fastest
  std::vector<Squared> along_x_, along_y_, outside_, inside_;
};

template <class IsIn>
void LatticeDistance::compute(int cells_per_voxel, const Vector3i& low, const Vector3i& size, const Vector3i& first,
                              const Vector3i& last, const IsIn& is_in) {
  n_ = cells_per_voxel;
  low_ = low;
  size_ = size;
  first_ = first;
  count_ = last - first + Vector3i::Ones();
  voxels_.clear();
  bool is_any_in = false;
  forEachPoint(first, last + Vector3i::Ones(), [&](const Vector3i& voxel) {
    voxels_.push_back(is_in(voxel));
    is_any_in |= voxels_.back() != 0;
  });
  if (is_any_in) {
    transform(true, outside_);
  } else {
    outside_.assign(static_cast<std::size_t>(size.prod()), kNone);
  }
  const bool is_outside = std::find(outside_.begin(), outside_.end(), 0) == outside_.end();
  if (!is_outside) transform(false, inside_);
}

}  // namespace sdf_ccd
