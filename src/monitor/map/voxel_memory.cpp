#include "voxel_memory.h"

#include <algorithm>
#include <utility>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

TileBits bitsOf(const TileMap& tiles, TileKey key) {
  const auto found = tiles.find(key);
  return found == tiles.end() ? TileBits() : found->second;
}

void add(TileMap& tiles, TileKey key, const TileBits& bits) {
  if (bits.any()) tiles[key] |= bits;
}

/// Removes the voxels of `other`.
void remove(TileMap& tiles, const TileMap& other) {
  for (auto tile = tiles.begin(); tile != tiles.end();) {
    tile->second &= ~bitsOf(other, tile->first);
    tile = tile->second.any() ? std::next(tile) : tiles.erase(tile);
  }
}

}  // namespace

void VoxelMemory::watch(VoxelGrid& grid) const {
  for (const State* state : {&before_, &now_}) {
    grid.watch(state->obstacles);
    grid.watch(state->unproven);
  }
}

VoxelMemory::Seen VoxelMemory::see(const VoxelGrid& grid, const std::vector<VoxelMask>& masks, bool is_robot_known,
                                   bool is_again) const {
  Seen seen;
  State& next = seen.after = is_again ? before_ : now_;
  grid.clearFree(next.obstacles);
  grid.clearFree(next.unproven);
  seen.forgotten = limit(next.obstacles, grid, masks);
  limit(next.unproven, grid, masks);
  for (const auto& [key, bits] : next.obstacles) {
    const auto tile = grid.tiles().find(key);
    seen.unseen += (tile == grid.tiles().end() ? bits : bits & ~tile->second.occupied).count();
  }
  VoxelGrid::Occupied occupied = grid.occupied(masks, next.obstacles);
  for (const auto& [key, tile] : grid.tiles()) {
    const TileBits counts = tile.occupied & ~bitsOf(occupied.hidden, key);
    const TileBits unsure = is_robot_known ? bitsOf(occupied.unsure, key) : counts;
    add(next.obstacles, key, counts & ~unsure);
    add(next.unproven, key, counts & unsure);
  }
  if (!next.has_map)
    for (const auto& [key, bits] : occupied.hidden) add(next.unproven, key, bits);
  next.has_map = true;
  remove(next.unproven, next.obstacles);
  for (const auto& [key, bits] : occupied.hidden) seen.unproven += (bits & bitsOf(next.unproven, key)).count();
  seen.masked = occupied.masked;
  seen.tiles = std::move(occupied.tiles);
  return seen;
}

/// Forgets tiles of which the map knows nothing, if there are too many: those farthest from the robot.
/// @return the number of voxels that are forgotten.
std::size_t VoxelMemory::limit(TileMap& remembered, const VoxelGrid& grid, const std::vector<VoxelMask>& masks) const {
  const auto isInMap = [&](TileKey key) {
    const auto found = grid.tiles().find(key);
    return found != grid.tiles().end() && found->second.occupied.any();
  };
  std::size_t in_map = 0;
  for (const auto& [key, tile] : grid.tiles()) in_map += tile.occupied.any() ? 1 : 0;
  std::vector<std::pair<double, TileKey>> others;  // with their distances to the robot [m]
  for (const auto& [key, bits] : remembered) {
    if (isInMap(key)) continue;
    const Vector3d center_M =
        cornerOf(kTileSide * tileOf(key), grid.size()) + Vector3d::Constant(0.5 * kTileSide * grid.size());
    double distance = kInfinity;
    for (const VoxelMask& mask : masks) distance = std::min(distance, (mask.center_M - center_M).norm() - mask.radius);
    others.emplace_back(distance, key);
  }
  const std::size_t room = (max_tiles_ - std::min(max_tiles_, in_map)) / 2;  // the rest is for unknown space
  if (others.size() <= room) return 0;
  std::sort(others.begin(), others.end());
  std::size_t forgotten = 0;
  for (std::size_t i = room; i < others.size(); ++i) {
    const auto tile = remembered.find(others[i].second);
    forgotten += tile->second.count();
    remembered.erase(tile);
  }
  return forgotten;
}

void VoxelMemory::accept(State after, bool is_again) {
  if (!is_again) before_ = std::move(now_);
  now_ = std::move(after);
}

}  // namespace sdf_ccd
