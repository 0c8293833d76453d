#include "voxel_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/number_text.h"
#include "geometry/octree_leaves.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

constexpr int kLevels = 17;  // levels of the tree, from a single voxel to the whole tree

/// Key of the octree's cube at a level that contains a voxel.
std::uint64_t cubeAt(const Vector3i& voxel, int level) {
  const auto place = [&](int axis) { return static_cast<std::uint64_t>(voxel[axis] >> level); };
  return static_cast<std::uint64_t>(level) << 48 | place(2) << 32 | place(1) << 16 | place(0);
}

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

}  // namespace

VoxelGrid::VoxelGrid(double size, const VoxelMapOptions& options)
    : size_(size), options_(options), keeps_known_(options.unknown != UnknownSpace::kFree) {
  if (!(size > 0.0) || !(size * kVoxelsAcross < 1e8) || !(size > 1e-6))
    throw std::invalid_argument("map: voxel size " + numberText(size) + " m is not valid");
}

VoxelGrid::Tile& VoxelGrid::tileAt(const Vector3i& tile) {
  const TileKey key = keyOf(tile);
  if (key == last_) return *last_tile_;
  last_tile_ = &tiles_[key];
  last_ = key;
  if (tiles_.size() > options_.max_tiles)
    throw std::runtime_error("a map of more than " + std::to_string(options_.max_tiles) + " tiles of " +
                             numberText(kTileSide * size_) + " m");
  return *last_tile_;
}

void VoxelGrid::add(const Vector3i& low, int side, bool is_occupied) {
  if (!is_occupied && !keeps_known_) return;
  const double count = double(side) * side * side;
  if (is_occupied) {
    if (double(occupied_) + count > double(options_.max_voxels))
      throw std::runtime_error("a map of more than " + std::to_string(options_.max_voxels) + " occupied voxels");
    occupied_ += static_cast<std::size_t>(count);
  }
  const Vector3i first = low / kTileSide, last = (low.array() + side - 1) / kTileSide;
  const Vector3i tiles = last - first;
  if (double(tiles.x() + 1) * (tiles.y() + 1) * (tiles.z() + 1) > double(options_.max_tiles)) {
    if (!is_occupied) return addLargeFree(low, side);
    throw std::runtime_error("a map of more than " + std::to_string(options_.max_tiles) + " tiles");
  }
  for (Vector3i t = first; t.z() <= last.z(); ++t.z())
    for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
      for (t.x() = first.x(); t.x() <= last.x(); ++t.x()) {
        Tile& tile = tileAt(t);
        const Vector3i from = (low - kTileSide * t).cwiseMax(0);
        const Vector3i to = (low - kTileSide * t + Vector3i::Constant(side)).cwiseMin(kTileSide);
        for (int z = from.z(); z < to.z(); ++z)
          for (int y = from.y(); y < to.y(); ++y)
            for (int x = from.x(); x < to.x(); ++x) {
              if (is_occupied) tile.occupied.set(voxelIndex(x, y, z));
              if (keeps_known_) tile.known.set(voxelIndex(x, y, z));
            }
      }
}

void VoxelGrid::addLargeFree(const Vector3i& low, int side) {
  int level = 0;
  while (level + 1 < kLevels && 1 << level < side) ++level;
  if (side != 1 << level || side < kTileSide || ((low.array() / side) * side != low.array()).any())
    throw std::invalid_argument("free space of " + std::to_string(side) + " voxels that is no leaf of an octree");
  large_free_.insert(cubeAt(low, level));
  lowest_large_ = std::min(lowest_large_, level);
}

std::optional<std::uint64_t> VoxelGrid::largeFreeAt(const Vector3i& voxel) const {
  for (int level = lowest_large_; level < kLevels; ++level)
    if (large_free_.count(cubeAt(voxel, level)) > 0) return cubeAt(voxel, level);
  return std::nullopt;
}

/// Voxels of a tile whose state is known.
TileBits VoxelGrid::known(const Vector3i& tile) const {
  const auto found = tiles_.find(keyOf(tile));
  TileBits bits = found == tiles_.end() ? TileBits() : found->second.known;
  if (large_free_.empty()) return bits;
  checkCancelled();
  // Such a leaf is larger than a tile, so it contains a corner of each tile that it meets.
  std::array<std::optional<std::uint64_t>, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = largeFreeAt(kTileSide * tile + (kTileSide - 1) * Vector3i(i & 1, i >> 1 & 1, i >> 2));
  if (std::none_of(corners.begin(), corners.end(), [](const auto& corner) { return corner.has_value(); })) return bits;
  if (std::all_of(corners.begin(), corners.end(), [&](const auto& corner) { return corner == corners[0]; }))
    return bits.set();
  for (int z = 0; z < kTileSide; ++z)
    for (int y = 0; y < kTileSide; ++y)
      for (int x = 0; x < kTileSide; ++x)
        if (largeFreeAt(kTileSide * tile + Vector3i(x, y, z))) bits.set(voxelIndex(x, y, z));
  return bits;
}

void VoxelGrid::addOctree(const std::int8_t* data, std::size_t bytes, const std::string& type, bool is_binary) {
  const bool is_color = type == "ColorOcTree";
  if (type != "OcTree" && !is_color)
    throw std::runtime_error("a map of type " + type.substr(0, 64) + "; only OcTree and ColorOcTree are read");
  const OctreeData kind = is_binary ? OctreeData::kBinary : is_color ? OctreeData::kFullColor : OctreeData::kFull;
  std::size_t leaves = 0;
  visitLeaves(data, bytes, kind, [&](const OctreeLeaf& leaf) {
    if (++leaves % 4096 == 0) checkCancelled();
    add({leaf.low[0], leaf.low[1], leaf.low[2]}, 1 << leaf.level, leaf.is_occupied);
  });
}

/// Of the space within the bounding box of the known tiles.
void VoxelGrid::addUnknown(TileMap& occupied) const {
  if (tiles_.empty()) return;
  Vector3i first = tileOf(tiles_.begin()->first), last = first;
  for (const auto& [key, tile] : tiles_) {
    first = first.cwiseMin(tileOf(key));
    last = last.cwiseMax(tileOf(key));
  }
  const Vector3i count = last - first;
  if (double(count.x() + 1) * (count.y() + 1) * (count.z() + 1) > double(options_.max_tiles))
    throw std::runtime_error("a map whose unknown space is more than " + std::to_string(options_.max_tiles) + " tiles");
  for (Vector3i t = first; t.z() <= last.z(); ++t.z())
    for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
      for (t.x() = first.x(); t.x() <= last.x(); ++t.x()) occupied[keyOf(t)] |= ~known(t);
}

void VoxelGrid::addUnknownNear(const VoxelMask& mask, TileMap& occupied) const {
  constexpr double kMaxTested = 500.0;  // of the tiles that may be marked; a test takes less than a microsecond
  const double near = options_.near_distance, reach = mask.radius + near;
  const Vector3d half = Vector3d::Constant(0.5 * kTileSide * size_);  // of a tile
  const auto refuse = [&] {
    throw std::runtime_error("map: the voxels are too small for near_distance (more than " +
                             std::to_string(options_.max_tiles) + " tiles)");
  };
  const TilesNear tiles(mask.center_M, reach, size_);
  if (tiles.count() > kMaxTested * double(options_.max_tiles)) refuse();
  std::size_t marked = 0;
  tiles.forEach([&](const Vector3i& t) {
    checkCancelled();
    if (!mask.isWithin(near + half.norm(), cornerOf(kTileSide * t, size_) + half)) return;
    const auto found = occupied.find(keyOf(t));
    TileBits bits = found == occupied.end() ? TileBits() : found->second;
    const TileBits given = known(t) | bits;
    bool is_marked = false;
    visitNear(t, size_, mask.center_M, reach, [&](std::size_t i, const Vector3d& p_M) {
      if (given[i] || !mask.isWithin(near, p_M)) return;
      bits.set(i);
      is_marked = true;
    });
    if (!is_marked) return;
    if (++marked > options_.max_tiles) refuse();
    occupied[keyOf(t)] = bits;
  });
}

/// @return the number of hidden voxels.
std::size_t VoxelGrid::hide(const VoxelMask& mask, TileMap& occupied) const {
  const double pad = options_.padding + 0.5 * size_, reach = mask.radius + pad;
  std::size_t hidden = 0;
  const auto hideIn = [&](TileKey key, TileBits& bits) {
    const auto tile = tiles_.find(key);
    const TileBits seen = tile != tiles_.end() ? tile->second.occupied : TileBits();
    visitNear(tileOf(key), size_, mask.center_M, reach, [&](std::size_t i, const Vector3d& p_M) {
      if (!bits[i] || (seen[i] && mask.only_unknown)) return;
      if (!mask.isWithin(pad, p_M, !(seen[i] && mask.is_open))) return;
      bits.reset(i);
      ++hidden;
    });
  };
  const TilesNear tiles(mask.center_M, reach, size_);
  if (tiles.count() > double(occupied.size())) {  // a large mask and small voxels
    for (auto& [key, bits] : occupied)
      if (tiles.contains(tileOf(key))) hideIn(key, bits);
    return hidden;
  }
  tiles.forEach([&](const Vector3i& t) {
    const auto found = occupied.find(keyOf(t));
    if (found != occupied.end()) hideIn(found->first, found->second);
  });
  return hidden;
}

VoxelGrid::Occupied VoxelGrid::occupied(const std::vector<VoxelMask>& masks) const {
  Occupied result;
  result.tiles.reserve(tiles_.size());
  for (const auto& [key, tile] : tiles_)
    if (tile.occupied.any()) result.tiles.emplace(key, tile.occupied);
  if (options_.unknown == UnknownSpace::kOccupied) addUnknown(result.tiles);
  if (options_.unknown == UnknownSpace::kOccupiedNear)
    for (const VoxelMask& mask : masks) addUnknownNear(mask, result.tiles);
  for (const VoxelMask& mask : masks) {
    checkCancelled();
    result.masked += hide(mask, result.tiles);
  }
  return result;
}

}  // namespace sdf_ccd
