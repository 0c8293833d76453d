#include "field/lattice_distance.h"

namespace sdf_ccd {

/// Squared distances along x from a row of lattice points to the occupied (or free) voxels of one row of the window;
/// kNone if there are none.
void LatticeDistance::alongX(const std::uint8_t* voxels, bool to_occupied, Squared* row) {
  constexpr int kFar = 1000;
  const int points = size_.x();
  std::array<int, 512> away;
  std::fill_n(away.begin(), points, kFar);
  // Distances from the row's first point to voxels that end before it, and from its last to those that begin behind.
  int before = kFar, behind = kFar;
  bool is_any = false;
  for (int i = 0; i < count_.x(); ++i) {
    if ((voxels[i] != 0) != to_occupied) continue;
    is_any = true;
    const int begin = n_ * (first_.x() + i) - low_.x(), end = begin + n_;
    if (end < 0) {
      before = -end;
    } else if (begin >= points) {
      behind = std::min(behind, begin - (points - 1));
    } else {
      for (int p = std::max(begin, 0); p <= std::min(end, points - 1); ++p) away[static_cast<std::size_t>(p)] = 0;
    }
  }
  if (!is_any) {
    std::fill_n(row, points, kNone);
    return;
  }
  for (int p = 0; p < points; ++p) {
    int& here = away[static_cast<std::size_t>(p)];
    here = std::min(here, before);
    before = here + 1;
  }
  for (int p = points - 1; p >= 0; --p) {
    const int here = std::min(away[static_cast<std::size_t>(p)], behind);
    behind = here + 1;
    row[p] = static_cast<Squared>(std::min(here * here, int(kNone)));
  }
}

void LatticeDistance::transform(bool to_occupied, std::vector<Squared>& squares) {
  const auto rows = static_cast<std::size_t>(count_.y()) * static_cast<std::size_t>(count_.z());
  const auto length = static_cast<std::size_t>(size_.x());
  along_x_.resize(length * rows);
  for (std::size_t r = 0; r < rows; ++r)
    alongX(voxels_.data() + r * static_cast<std::size_t>(count_.x()), to_occupied, along_x_.data() + r * length);
  const auto isNone = [](const Squared* from, std::size_t size) {
    return std::all_of(from, from + size, [](Squared d) { return d == kNone; });
  };
  const std::size_t layer = length * static_cast<std::size_t>(size_.y());
  along_y_.assign(layer * static_cast<std::size_t>(count_.z()), kNone);
  for (int k = 0; k < count_.z(); ++k)
    for (int j = 0; j < count_.y(); ++j) {
      const Squared* const from = along_x_.data() + length * static_cast<std::size_t>(k * count_.y() + j);
      if (isNone(from, length)) continue;
      for (int y = 0; y < size_.y(); ++y)
        takeLeast(from, length, squared(1, y, j),
                  along_y_.data() + layer * static_cast<std::size_t>(k) + length * static_cast<std::size_t>(y));
    }
  squares.assign(layer * static_cast<std::size_t>(size_.z()), kNone);
  for (int k = 0; k < count_.z(); ++k) {
    const Squared* const from = along_y_.data() + layer * static_cast<std::size_t>(k);
    if (isNone(from, layer)) continue;
    for (int z = 0; z < size_.z(); ++z)
      takeLeast(from, layer, squared(2, z, k), squares.data() + layer * static_cast<std::size_t>(z));
  }
}

}  // namespace sdf_ccd
