#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sdf_ccd/types.h"

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
    cells_.push_back(hash(cell(p)));
    next_.push_back(-1);
    link(index);
  }

  /// Calls visit(index) for every point within reach of p, and perhaps for others, until it returns true.
  /// @return whether it did.
  template <typename Visit>
  bool anyNear(const Vector3d& p, Visit visit) const {
    return anyWithin(p, 0.5 / scale_, visit);
  }

  /// The same for any other distance; points may be visited more than once.
  template <typename Visit>
  bool anyWithin(const Vector3d& p, double reach, Visit visit) const {
    const Cell low = cell(p.array() - reach), high = cell(p.array() + reach);
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
          for (std::int32_t i = heads_[hash({x, y, z}) & (heads_.size() - 1)]; i >= 0; i = next_[i])
            if (visit(i)) return true;
    return false;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;

  Cell cell(const Vector3d& p) const {
    const auto along = [&](int axis) { return static_cast<std::int64_t>(std::floor(p[axis] * scale_)); };
    return {along(0), along(1), along(2)};
  }

  static std::uint64_t hash(const Cell& cell) {
    // Odd constants of Teschner et al. 2003, then a mix of the upper bits into those that choose the bucket.
    std::uint64_t code = static_cast<std::uint64_t>(cell[0]) * 73856093u ^
                         static_cast<std::uint64_t>(cell[1]) * 19349663u ^
                         static_cast<std::uint64_t>(cell[2]) * 83492791u;
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
