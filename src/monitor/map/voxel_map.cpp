#include "voxel_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/parallel_for.h"
#include "field/voxel_field.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

static_assert(VoxelBlock::kSide == kTileSide + 2, "a tile and one voxel around it");

/// Name of a tile, by its indices counted from the map's origin.
std::string nameOf(const std::string& map, const Vector3i& tile) {
  const auto place = [&](int axis) {
    return std::to_string(static_cast<int>(std::floor(double(kTileSide * tile[axis] - kOriginVoxel) / kTileSide)));
  };
  return map + "/" + place(0) + "_" + place(1) + "_" + place(2);
}

/// Calls `visit` with a tile and those around it, until it returns true. @return whether it did.
template <class Visit>
bool anyAround(const Vector3i& tile, const Visit& visit) {
  for (int i = 0; i < 27; ++i) {
    const Vector3i other = tile + Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (other.minCoeff() >= 0 && visit(other)) return true;
  }
  return false;
}

/// A tile's voxels and those around it.
VoxelBlock blockOf(const Vector3i& tile, const TileMap& all) {
  const TileBits* around[27];
  for (int i = 0; i < 27; ++i) {
    const Vector3i other = tile + Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto found = other.minCoeff() < 0 ? all.end() : all.find(keyOf(other));
    around[i] = found == all.end() ? nullptr : &found->second;
  }
  VoxelBlock block;
  const auto part = [](int v, int& in_tile) {  // v from -1 to kTileSide: which of three tiles, and the index in it
    in_tile = v < 0 ? kTileSide - 1 : v >= kTileSide ? 0 : v;
    return v < 0 ? 0 : v >= kTileSide ? 2 : 1;
  };
  for (int z = -1; z <= kTileSide; ++z)
    for (int y = -1; y <= kTileSide; ++y)
      for (int x = -1; x <= kTileSide; ++x) {
        int u = 0, v = 0, w = 0;
        const TileBits* const bits = around[part(x, u) + 3 * part(y, v) + 9 * part(z, w)];
        if (bits && (*bits)[voxelIndex(u, v, w)]) block.occupied.set(VoxelBlock::index(x + 1, y + 1, z + 1));
      }
  return block;
}

/// Keys of the tiles in which something is occupied, in ascending order.
std::vector<TileKey> occupiedTiles(const TileMap& occupied) {
  std::vector<TileKey> keys;
  for (const auto& [key, bits] : occupied)
    if (bits.any()) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  return keys;
}

}  // namespace

struct VoxelMap::Tile {
  TileBits own;  // without the voxels around the tile
  VoxelBlock block;
};

VoxelMap::VoxelMap(std::string name, std::string frame, const VoxelMapOptions& options)
    : name_(std::move(name)), frame_(std::move(frame)), options_(options) {}

struct VoxelMap::Made {
  TileKey key = 0;
  std::shared_ptr<const Tile> tile;
  std::optional<BodyDescription> body;  // if the tile is new
};

/// A new tile.
VoxelMap::Made VoxelMap::make(TileKey key, const TileMap& occupied, double size) const {
  const Vector3i tile = tileOf(key);
  const auto made_tile = std::make_shared<Tile>(Tile{occupied.at(key), blockOf(tile, occupied)});
  const VoxelLattice place{cornerOf((kTileSide * tile).array() - 1, size), size};
  GeometryDescription geometry;
  geometry.shape = std::make_shared<const TriangleMesh>(voxelSurface(made_tile->block, place));
  geometry.source = name_;
  geometry.watertight_voxels = true;
  geometry.cell_size = 0.5 * size;
  geometry.field = voxelField(made_tile->block, place, options_.band);
  BodyDescription body;
  body.name = nameOf(name_, tile);
  body.frame = frame_;
  body.is_world = true;
  body.map = name_;
  body.geometry.push_back(std::move(geometry));
  return {key, made_tile, std::move(body)};
}

std::vector<VoxelMap::Made> VoxelMap::make(const TileMap& occupied, double size, const Tiles& last) const {
  std::unordered_set<TileKey> changed;
  for (const auto& [key, bits] : occupied) {
    const auto found = last.find(key);
    if (found == last.end() ? bits.any() : found->second->own != bits) changed.insert(key);
  }
  for (const auto& [key, tile] : last)
    if (occupied.count(key) == 0) changed.insert(key);
  const auto has_changed = [&](const Vector3i& tile) { return changed.count(keyOf(tile)) > 0; };

  const std::vector<TileKey> keys = occupiedTiles(occupied);
  if (keys.size() > options_.max_tiles)
    throw std::runtime_error("a map of more than " + std::to_string(options_.max_tiles) + " tiles");
  std::vector<Made> made(keys.size());
  const CancelPoint cancel;
  parallelFor(std::size_t{0}, keys.size(), [&](std::size_t k) {
    cancel.check();
    const Vector3i tile = tileOf(keys[k]);
    const auto found = last.find(keys[k]);
    const bool stays = found != last.end() && (!anyAround(tile, has_changed) ||
                                               found->second->block.occupied == blockOf(tile, occupied).occupied);
    made[k] = stays ? Made{keys[k], found->second, {}} : make(keys[k], occupied, size);
  });
  return made;
}

VoxelMap::Change VoxelMap::take(const VoxelGrid& grid, const std::vector<VoxelMask>& masks) {
  const auto [occupied, masked] = grid.occupied(masks);
  Change change;
  change.masked = masked;
  for (const auto& [key, bits] : occupied) change.occupied += bits.count();
  const Tiles none;
  Tiles tiles;
  for (Made& made : make(occupied, grid.size(), grid.size() == size_ ? tiles_ : none)) {
    tiles.emplace(made.key, std::move(made.tile));
    if (made.body) change.made.push_back(std::move(*made.body));
  }
  for (const auto& [key, tile] : tiles_)
    if (tiles.count(key) == 0) change.removed.push_back(nameOf(name_, tileOf(key)));
  tiles_ = std::move(tiles);
  size_ = grid.size();
  return change;
}

}  // namespace sdf_ccd
