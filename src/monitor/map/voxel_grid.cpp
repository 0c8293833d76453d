#include "voxel_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "mesh/octree_leaves.h"
#include "voxels_near.h"

namespace sdf_ccd {
namespace {

constexpr int kLevels = 17;  // levels of the tree, from a single voxel to the whole tree

/// Calls `visit` with the index of each voxel of a tile that a cube of voxels contains.
template <class Visit>
void forEachVoxel(const Vector3i& tile, const Vector3i& low, int side, const Visit& visit) {
  const Vector3i from = (low - kTileSide * tile).cwiseMax(0);
  const Vector3i to = (low - kTileSide * tile + Vector3i::Constant(side)).cwiseMin(kTileSide);
  for (int z = from.z(); z < to.z(); ++z)
    for (int y = from.y(); y < to.y(); ++y)
      for (int x = from.x(); x < to.x(); ++x) visit(voxelIndex(x, y, z));
}

/// Key of the octree's cube at a level that contains a voxel.
std::uint64_t cubeAt(const Vector3i& voxel, int level) {
  const auto place = [&](int axis) { return static_cast<std::uint64_t>(voxel[axis] >> level); };
  return static_cast<std::uint64_t>(level) << 48 | place(2) << 32 | place(1) << 16 | place(0);
}

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

void VoxelGrid::watch(const TileMap& tiles) {
  for (const auto& [key, bits] : tiles) free_.try_emplace(key);
}

/// In the watched tiles.
void VoxelGrid::addFree(const Vector3i& low, int side) {
  if (free_.empty()) return;
  const Vector3i first = low / kTileSide, last = (low.array() + side - 1) / kTileSide;
  const auto addTo = [&](const Vector3i& t, TileBits& free) {
    forEachVoxel(t, low, side, [&](std::size_t i) { free.set(i); });
  };
  if ((last - first + Vector3i::Ones()).cast<double>().prod() > double(free_.size())) {
    for (auto& [key, free] : free_) {
      const Vector3i t = tileOf(key);
      if ((t.array() >= first.array()).all() && (t.array() <= last.array()).all()) addTo(t, free);
    }
    return;
  }
  for (Vector3i t = first; t.z() <= last.z(); ++t.z())
    for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
      for (t.x() = first.x(); t.x() <= last.x(); ++t.x())
        if (const auto found = free_.find(keyOf(t)); found != free_.end()) addTo(t, found->second);
}

void VoxelGrid::clearFree(TileMap& voxels) const {
  for (auto tile = voxels.begin(); tile != voxels.end();) {
    if (const auto free = free_.find(tile->first); free != free_.end()) tile->second &= ~free->second;
    tile = tile->second.any() ? std::next(tile) : voxels.erase(tile);
  }
}

void VoxelGrid::add(const Vector3i& low, int side, bool is_occupied) {
  has_free_ |= !is_occupied;
  if (!is_occupied) addFree(low, side);
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
        forEachVoxel(t, low, side, [&](std::size_t i) {
          if (is_occupied) tile.occupied.set(i);
          if (keeps_known_) tile.known.set(i);
        });
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

void VoxelGrid::hide(const VoxelMask& mask, const TileMap& remembered, Occupied& result) const {
  const double pad = options_.padding + 0.5 * size_;
  forTilesNear(result.tiles, size_, mask.center_M, mask.radius + pad, [&](TileKey key, TileBits& bits) {
    const auto tile = tiles_.find(key);
    const TileBits seen = tile != tiles_.end() ? tile->second.occupied : TileBits();
    const auto known = remembered.find(key);
    const TileBits may_hide = known != remembered.end() ? bits & ~known->second : bits;
    if (may_hide.none()) return;
    visitNear(tileOf(key), size_, mask.center_M, mask.radius + pad, [&](std::size_t i, const Vector3d& p_M) {
      if (!may_hide[i] || (seen[i] && mask.only_unknown && !mask.is_guess)) return;
      if (!mask.isWithin(pad, p_M, !(seen[i] && mask.is_open))) return;
      if (seen[i] && mask.only_unknown) {
        result.unsure[key].set(i);
        return;
      }
      bits.reset(i);
      if (seen[i]) result.hidden[key].set(i);
      ++result.masked;
    });
  });
}

VoxelGrid::Occupied VoxelGrid::occupied(const std::vector<VoxelMask>& masks, const TileMap& remembered) const {
  Occupied result;
  result.tiles = remembered;
  result.tiles.reserve(tiles_.size() + remembered.size());
  for (const auto& [key, tile] : tiles_)
    if (tile.occupied.any()) result.tiles[key] |= tile.occupied;
  if (options_.unknown == UnknownSpace::kOccupied) addUnknown(result.tiles);
  if (options_.unknown == UnknownSpace::kOccupiedNear)
    for (const VoxelMask& mask : masks) addUnknownNear(mask, result.tiles);
  for (const VoxelMask& mask : masks) {
    checkCancelled();
    hide(mask, remembered, result);
  }
  return result;
}

}  // namespace sdf_ccd
