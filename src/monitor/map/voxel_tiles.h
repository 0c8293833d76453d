#pragma once

#include <bitset>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "sdf_ccd/types.h"

/// Voxels of a map, in tiles. Both are indexed from the lowest corner of the largest octree, of 2¹⁶ voxels a side:
/// voxel kOriginVoxel begins at the map's origin, as in OctreeLeaf.
namespace sdf_ccd {

constexpr int kTileSide = 18;           // voxels along a tile's side
constexpr int kVoxelsAcross = 1 << 16;  // along a side of the whole tree
constexpr int kOriginVoxel = kVoxelsAcross / 2;

using TileBits = std::bitset<std::size_t{kTileSide} * kTileSide * kTileSide>;  // see voxelIndex()
using TileKey = std::uint64_t;
using TileMap = std::unordered_map<TileKey, TileBits>;

inline TileKey keyOf(const Vector3i& tile) {
  return static_cast<TileKey>(tile.z()) << 32 | static_cast<TileKey>(tile.y()) << 16 | static_cast<TileKey>(tile.x());
}

inline Vector3i tileOf(TileKey key) {
  return {static_cast<int>(key & 0xFFFF), static_cast<int>(key >> 16 & 0xFFFF), static_cast<int>(key >> 32)};
}

/// Index in TileBits of a voxel counted from the tile's lowest one.
inline std::size_t voxelIndex(int x, int y, int z) {
  return (static_cast<std::size_t>(z) * kTileSide + static_cast<std::size_t>(y)) * kTileSide +
         static_cast<std::size_t>(x);
}

/// Lowest corner of a voxel [m].
inline Vector3d cornerOf(const Vector3i& voxel, double size) {
  return size * (voxel.array() - kOriginVoxel).cast<double>().matrix();
}

}  // namespace sdf_ccd
