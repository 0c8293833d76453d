#pragma once

#include <algorithm>
#include <cmath>

#include "voxel_tiles.h"

/// The voxels of a map near a point.
namespace sdf_ccd {

/// Calls `visit` for each voxel of a tile whose centre is within `reach` of a point.
template <class Visit>
void visitNear(const Vector3i& tile, double size, const Vector3d& center, double reach, const Visit& visit) {
  const Vector3d corner = cornerOf(kTileSide * tile, size);
  const Vector3d low = (center - corner - Vector3d::Constant(reach)) / size;
  const Vector3d high = (center - corner + Vector3d::Constant(reach)) / size;
  const auto clamp = [](double x) { return static_cast<int>(std::clamp(x, 0.0, double(kTileSide))); };
  const Vector3i from(clamp(std::floor(low.x())), clamp(std::floor(low.y())), clamp(std::floor(low.z())));
  const Vector3i to(clamp(std::ceil(high.x())), clamp(std::ceil(high.y())), clamp(std::ceil(high.z())));
  for (int z = from.z(); z < to.z(); ++z)
    for (int y = from.y(); y < to.y(); ++y)
      for (int x = from.x(); x < to.x(); ++x) {
        const Vector3d p = corner + size * (Vector3d(x, y, z).array() + 0.5).matrix();
        if ((p - center).squaredNorm() <= reach * reach) visit(voxelIndex(x, y, z), p);
      }
}

/// The tiles that the bounding box of a ball meets.
struct TilesNear {
  Vector3i first, last;

  TilesNear(const Vector3d& center, double reach, double size) {
    const auto tile = [&](double x) {
      const double voxel = std::floor(x / size) + kOriginVoxel;
      return static_cast<int>(std::clamp(voxel, 0.0, double(kVoxelsAcross - 1))) / kTileSide;
    };
    for (int k = 0; k < 3; ++k) {
      first[k] = tile(center[k] - reach);
      last[k] = tile(center[k] + reach);
    }
  }

  double count() const { return (last - first + Vector3i::Ones()).cast<double>().prod(); }
  bool contains(const Vector3i& tile) const {
    return (tile.array() >= first.array()).all() && (tile.array() <= last.array()).all();
  }

  template <class Visit>
  void forEach(const Visit& visit) const {
    for (Vector3i t = first; t.z() <= last.z(); ++t.z())
      for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
        for (t.x() = first.x(); t.x() <= last.x(); ++t.x()) visit(t);
  }
};

/// Calls `visit` with the key and the voxels of each tile of a TileMap that the bounding box of a ball meets. The ball
/// may be unbounded.
template <class Tiles, class Visit>
void forTilesNear(Tiles& tiles, double size, const Vector3d& center, double reach, const Visit& visit) {
  const TilesNear near(center, reach, size);
  if (near.count() > double(tiles.size())) {  // a large ball and small voxels
    for (auto& [key, bits] : tiles)
      if (near.contains(tileOf(key))) visit(key, bits);
    return;
  }
  near.forEach([&](const Vector3i& t) {
    const auto found = tiles.find(keyOf(t));
    if (found != tiles.end()) visit(found->first, found->second);
  });
}

}  // namespace sdf_ccd
