#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A growing set of oriented points, and queries for those within a fixed distance of a location.
///
/// Cells are twice that distance wide, so that eight of them hold all candidates. Cells that hash to one bucket
/// share its list; the visitor measures distances itself.
class PointGrid {
 public:
  explicit PointGrid(double reach) : scale_(1 / (2 * reach)), heads_(1024, -1) {}

  void insert(const Vector3d& p) {
    if (cells_.size() >= heads_.size()) grow();
    const std::int32_t index = static_cast<std::int32_t>(cells_.size());
    cells_.push_back(hash(cell(p, 0), cell(p, 1), cell(p, 2)));
    next_.push_back(-1);
    link(index);
  }

  /// Calls visit(index) for every point within reach of p, and perhaps for others, until it returns true.
  /// @return whether it did.
  template <typename Visit>
  bool anyNear(const Vector3d& p, Visit visit) const {
    std::int64_t low[3];
    for (int axis = 0; axis < 3; ++axis) low[axis] = static_cast<std::int64_t>(std::floor(p[axis] * scale_ - 0.5));
    for (int corner = 0; corner < 8; ++corner) {
      const std::uint64_t code = hash(low[0] + (corner & 1), low[1] + (corner >> 1 & 1), low[2] + (corner >> 2));
      for (std::int32_t i = heads_[code & (heads_.size() - 1)]; i >= 0; i = next_[i]) {
        if (visit(i)) return true;
      }
    }
    return false;
  }

 private:
  std::int64_t cell(const Vector3d& p, int axis) const {
    return static_cast<std::int64_t>(std::floor(p[axis] * scale_));
  }

  static std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
    // Odd constants of Teschner et al. 2003, then a mix of the upper bits into those that choose the bucket.
    std::uint64_t code = static_cast<std::uint64_t>(x) * 73856093u ^ static_cast<std::uint64_t>(y) * 19349663u ^
                         static_cast<std::uint64_t>(z) * 83492791u;
    code *= 0x9E3779B97F4A7C15ULL;
    return code >> 24;
  }

  void link(std::int32_t index) {
    std::int32_t& head = heads_[cells_[index] & (heads_.size() - 1)];
    next_[index] = head;
    head = index;
  }

  void grow() {
    heads_.assign(2 * heads_.size(), -1);
    for (std::size_t i = 0; i < cells_.size(); ++i) link(static_cast<std::int32_t>(i));
  }

  double scale_;
  std::vector<std::int32_t> heads_;  // a power of two of buckets
  std::vector<std::uint64_t> cells_;
  std::vector<std::int32_t> next_;
};

}  // namespace sdf_ccd
