#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "common/cancel_point.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Numbers different points in the order in which they come. By open addressing, because freeing a map of nodes takes
/// as long as filling it, and cannot be cancelled.
class PointNumbers {
 public:
  /// @param expected  number of points; the table grows if there are more.
  explicit PointNumbers(std::size_t expected) {
    std::size_t size = 16;
    while (size < 2 * expected) size *= 2;
    numbers_.assign(size, kNone);
  }

  int numberOf(const Vector3d& p) {
    int& number = slotOf(p);
    if (number != kNone) return number;
    const int added = number = static_cast<int>(points.size());
    points.push_back(p);
    if (2 * points.size() > numbers_.size()) grow();
    return added;
  }

  std::vector<Vector3d> points;

 private:
  static constexpr int kNone = -1;

  static std::size_t hashOf(const Vector3d& p) {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits;
      std::memcpy(&bits, &p[axis], sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;  // 2^64 / golden ratio: spreads every bit upwards
      hash ^= hash >> 32;
    }
    return hash;
  }

  /// The entry of a point: its number, or kNone where that belongs.
  int& slotOf(const Vector3d& p) {
    for (std::size_t slot = hashOf(p);; ++slot) {
      int& number = numbers_[slot & (numbers_.size() - 1)];
      if (number == kNone || points[number] == p) return number;
    }
  }

  void grow() {
    CancelTicks<4096> cancel;
    numbers_.assign(2 * numbers_.size(), kNone);
    for (std::size_t i = 0; i < points.size(); ++i) {
      cancel.check();
      slotOf(points[i]) = static_cast<int>(i);
    }
  }

  std::vector<int> numbers_;
};

}  // namespace sdf_ccd
