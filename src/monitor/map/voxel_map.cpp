#include "voxel_map.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/parallel_for.h"
#include "field/voxel_field.h"

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
    : name_(std::move(name)), frame_(std::move(frame)), options_(options), memory_(options.max_tiles) {}

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

VoxelMap::Change VoxelMap::replaceTiles(TileMap visible, const VoxelObjects& objects, double size) {
  Change change;
  for (const auto& [key, bits] : visible) change.occupied += bits.count();
  std::map<std::string, std::pair<std::uint64_t, TileMap>> wanted;
  TileMap& others = wanted[""].second = visible;
  for (const auto& [name, object] : objects.found()) {
    TileMap& in_object = wanted[name].second;
    wanted[name].first = object.declared;
    for (const auto& [key, voxels] : object.voxels) {
      TileBits& free = others[key];  // for this object: voxels in several of them are in the first one's tiles
      const TileBits bits = voxels & free;
      free &= ~bits;
      if (bits.any()) in_object.emplace(key, bits);
      change.in_objects += bits.count();
    }
  }
  Layers layers;
  for (const auto& [object, declared_voxels] : wanted) {
    const auto& [declared, voxels] = declared_voxels;
    const auto last = layers_.find(object);
    const bool continues = size == size_ && last != layers_.end() && last->second.declared == declared;
    const std::string suffix = object.empty() ? "" : "/" + object;
    Layer& layer = layers[object];
    layer.declared = declared;
    for (Made& made : make(voxels, size, continues ? last->second.tiles : Tiles())) {
      layer.tiles.emplace(made.key, std::move(made.tile));
      if (!object.empty()) change.objects[nameOf(name_, tileOf(made.key)) + suffix] = {object, declared};
      if (!made.body) continue;
      made.body->name += suffix;
      change.made.push_back(std::move(*made.body));
    }
    if (layer.tiles.empty()) layers.erase(object);
  }
  for (const auto& [object, layer] : layers_) {
    const auto now = layers.find(object);
    for (const auto& [key, tile] : layer.tiles)
      if (now == layers.end() || now->second.tiles.count(key) == 0)
        change.removed.push_back(nameOf(name_, tileOf(key)) + (object.empty() ? "" : "/" + object));
  }
  layers_ = std::move(layers);
  visible_ = std::move(visible);
  size_ = size;
  return change;
}

void VoxelMap::watch(VoxelGrid& grid) const {
  if (grid.size() == size_) memory_.watch(grid);
}

VoxelMap::Change VoxelMap::update(const VoxelGrid& grid, const Surroundings& around) {
  VoxelMemory::Seen seen = memory_.see(grid, around.masks, around.is_robot_known, around.is_again);
  VoxelObjects objects = objects_;
  objects.judge(seen.tiles, grid.size(), around.objects, true);
  Change change = replaceTiles(std::move(seen.tiles), objects, grid.size());
  memory_.accept(std::move(seen.after), around.is_again);
  objects_ = std::move(objects);
  change.masked = seen.masked;
  change.unproven = seen.unproven;
  change.unseen = seen.unseen;
  change.forgotten = seen.forgotten;
  return change;
}

VoxelMap::Change VoxelMap::judgeAgain(const std::vector<ObjectMask>& objects) {
  VoxelObjects judged = objects_;
  const bool has_changed = judged.judge(visible_, size_, objects, false);
  Change change = has_changed ? replaceTiles(visible_, judged, size_) : Change();
  objects_ = std::move(judged);
  return change;
}

}  // namespace sdf_ccd
