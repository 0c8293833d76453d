#include "voxel_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <unordered_set>

#include "common/number_text.h"
#include "common/parallel_for.h"
#include "field/voxel_field.h"
#include "geometry/octree_leaves.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

constexpr int kTile = VoxelGrid::kTile;
constexpr int kCells = 1 << 16;      // voxels along a side of the whole tree
constexpr int kOrigin = kCells / 2;  // index of the voxel that begins at the map's origin
constexpr int kLevels = 17;          // levels of the tree, from a single voxel to the whole tree
static_assert(VoxelBlock::kSide == kTile + 2, "a tile and one voxel around it");

std::size_t indexOf(int x, int y, int z) {
  return (static_cast<std::size_t>(z) * kTile + static_cast<std::size_t>(y)) * kTile + static_cast<std::size_t>(x);
}

/// Name of a tile, by its indices counted from the map's origin.
std::string nameOf(const std::string& map, const Vector3i& tile) {
  const auto place = [&](int axis) {
    return std::to_string(static_cast<int>(std::floor(double(kTile * tile[axis] - kOrigin) / kTile)));
  };
  return map + "/" + place(0) + "_" + place(1) + "_" + place(2);
}

/// Lowest corner of a voxel [m].
Vector3d cornerOf(const Vector3i& voxel, double size) {
  return size * (voxel.array() - kOrigin).cast<double>().matrix();
}

/// Key of the octree's cube at a level that contains a voxel.
std::uint64_t cubeAt(const Vector3i& voxel, int level) {
  const auto place = [&](int axis) { return static_cast<std::uint64_t>(voxel[axis] >> level); };
  return static_cast<std::uint64_t>(level) << 48 | place(2) << 32 | place(1) << 16 | place(0);
}

}  // namespace

VoxelGrid::VoxelGrid(double size, const VoxelMapOptions& options)
    : size_(size), options_(options), keeps_known_(options.unknown != UnknownSpace::kFree) {
  if (!(size > 0.0) || !(size * kCells < 1e8) || !(size > 1e-6))
    throw std::invalid_argument("map: voxel size " + numberText(size) + " m is not valid");
}

VoxelGrid::Key VoxelGrid::keyOf(const Vector3i& tile) {
  return static_cast<Key>(tile.z()) << 32 | static_cast<Key>(tile.y()) << 16 | static_cast<Key>(tile.x());
}

Vector3i VoxelGrid::tileOf(Key key) {
  return {static_cast<int>(key & 0xFFFF), static_cast<int>(key >> 16 & 0xFFFF), static_cast<int>(key >> 32)};
}

VoxelGrid::Tile& VoxelGrid::tileAt(const Vector3i& tile) {
  const Key key = keyOf(tile);
  if (key == last_) return *last_tile_;
  last_tile_ = &tiles_[key];
  last_ = key;
  if (tiles_.size() > options_.max_tiles)
    throw std::runtime_error("a map of more than " + std::to_string(options_.max_tiles) + " tiles of " +
                             numberText(kTile * size_) + " m");
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
  const Vector3i first = low / kTile, last = (low.array() + side - 1) / kTile;
  const Vector3i tiles = last - first;
  if (double(tiles.x() + 1) * (tiles.y() + 1) * (tiles.z() + 1) > double(options_.max_tiles)) {
    if (!is_occupied) return addLargeFree(low, side);
    throw std::runtime_error("a map of more than " + std::to_string(options_.max_tiles) + " tiles");
  }
  for (Vector3i t = first; t.z() <= last.z(); ++t.z())
    for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
      for (t.x() = first.x(); t.x() <= last.x(); ++t.x()) {
        Tile& tile = tileAt(t);
        const Vector3i from = (low - kTile * t).cwiseMax(0);
        const Vector3i to = (low - kTile * t + Vector3i::Constant(side)).cwiseMin(kTile);
        for (int z = from.z(); z < to.z(); ++z)
          for (int y = from.y(); y < to.y(); ++y)
            for (int x = from.x(); x < to.x(); ++x) {
              if (is_occupied) tile.occupied.set(indexOf(x, y, z));
              if (keeps_known_) tile.known.set(indexOf(x, y, z));
            }
      }
}

void VoxelGrid::addLargeFree(const Vector3i& low, int side) {
  int level = 0;
  while (level + 1 < kLevels && 1 << level < side) ++level;
  if (side != 1 << level || side < kTile || ((low.array() / side) * side != low.array()).any())
    throw std::invalid_argument("free space of " + std::to_string(side) + " voxels that is no leaf of an octree");
  large_free_.insert(cubeAt(low, level));
  lowest_large_ = std::min(lowest_large_, level);
}

std::optional<VoxelGrid::Key> VoxelGrid::largeFreeAt(const Vector3i& voxel) const {
  for (int level = lowest_large_; level < kLevels; ++level)
    if (large_free_.count(cubeAt(voxel, level)) > 0) return cubeAt(voxel, level);
  return std::nullopt;
}

/// Voxels of a tile whose state is known.
VoxelGrid::Bits VoxelGrid::known(const Vector3i& tile) const {
  const auto found = tiles_.find(keyOf(tile));
  Bits bits = found == tiles_.end() ? Bits() : found->second.known;
  if (large_free_.empty()) return bits;
  checkCancelled();
  // Such a leaf is larger than a tile, so it contains a corner of each tile that it meets.
  std::array<std::optional<Key>, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = largeFreeAt(kTile * tile + (kTile - 1) * Vector3i(i & 1, i >> 1 & 1, i >> 2));
  if (std::none_of(corners.begin(), corners.end(), [](const auto& corner) { return corner.has_value(); })) return bits;
  if (std::all_of(corners.begin(), corners.end(), [&](const auto& corner) { return corner == corners[0]; }))
    return bits.set();
  for (int z = 0; z < kTile; ++z)
    for (int y = 0; y < kTile; ++y)
      for (int x = 0; x < kTile; ++x)
        if (largeFreeAt(kTile * tile + Vector3i(x, y, z))) bits.set(indexOf(x, y, z));
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

/// A tile as it was built.
struct VoxelMap::Built {
  VoxelGrid::Bits own;  // without the voxels around the tile
  VoxelBlock block;
};

VoxelMap::VoxelMap(std::string name, std::string frame, const VoxelMapOptions& options)
    : name_(std::move(name)), frame_(std::move(frame)), options_(options) {}

namespace {

using Bits = VoxelGrid::Bits;
using BitsOfTiles = std::unordered_map<std::uint64_t, Bits>;

/// Calls `visit` for each voxel of a tile whose centre is within `reach` of a point.
template <class Visit>
void visitNear(const Vector3i& tile, double size, const Vector3d& center, double reach, const Visit& visit) {
  const Vector3d corner = cornerOf(kTile * tile, size);
  const Vector3d low = (center - corner - Vector3d::Constant(reach)) / size;
  const Vector3d high = (center - corner + Vector3d::Constant(reach)) / size;
  const auto clamp = [](double x) { return static_cast<int>(std::clamp(x, 0.0, double(kTile))); };
  const Vector3i from(clamp(std::floor(low.x())), clamp(std::floor(low.y())), clamp(std::floor(low.z())));
  const Vector3i to(clamp(std::ceil(high.x())), clamp(std::ceil(high.y())), clamp(std::ceil(high.z())));
  for (int z = from.z(); z < to.z(); ++z)
    for (int y = from.y(); y < to.y(); ++y)
      for (int x = from.x(); x < to.x(); ++x) {
        const Vector3d p = corner + size * (Vector3d(x, y, z).array() + 0.5).matrix();
        if ((p - center).squaredNorm() <= reach * reach) visit(indexOf(x, y, z), p);
      }
}

/// The tiles that a ball meets.
std::vector<Vector3i> tilesNear(const Vector3d& center, double reach, double size, std::size_t most) {
  const auto tileOf = [&](double x) {
    const double voxel = std::floor(x / size) + kOrigin;
    return static_cast<int>(std::clamp(voxel, 0.0, double(kCells - 1))) / kTile;
  };
  Vector3i first, last;
  for (int k = 0; k < 3; ++k) {
    first[k] = tileOf(center[k] - reach);
    last[k] = tileOf(center[k] + reach);
  }
  std::vector<Vector3i> tiles;
  for (Vector3i t = first; t.z() <= last.z(); ++t.z())
    for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
      for (t.x() = first.x(); t.x() <= last.x(); ++t.x()) {
        if (tiles.size() >= most)
          throw std::runtime_error("map: the voxels are too small for near_distance (more than " +
                                   std::to_string(most) + " tiles)");
        tiles.push_back(t);
      }
  return tiles;
}

VoxelBlock blockOf(const Vector3i& tile, const BitsOfTiles& all,
                   const std::function<std::uint64_t(const Vector3i&)>& keyOf) {
  const Bits* around[27];
  for (int i = 0; i < 27; ++i) {
    const Vector3i other = tile + Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    const auto found = other.minCoeff() < 0 ? all.end() : all.find(keyOf(other));
    around[i] = found == all.end() ? nullptr : &found->second;
  }
  VoxelBlock block;
  const auto part = [](int v, int& in_tile) {  // v from -1 to kTile: which of three tiles, and the index in it
    in_tile = v < 0 ? kTile - 1 : v >= kTile ? 0 : v;
    return v < 0 ? 0 : v >= kTile ? 2 : 1;
  };
  for (int z = -1; z <= kTile; ++z)
    for (int y = -1; y <= kTile; ++y)
      for (int x = -1; x <= kTile; ++x) {
        int u = 0, v = 0, w = 0;
        const Bits* const bits = around[part(x, u) + 3 * part(y, v) + 9 * part(z, w)];
        if (bits && (*bits)[indexOf(u, v, w)]) block.occupied.set(VoxelBlock::index(x + 1, y + 1, z + 1));
      }
  return block;
}

}  // namespace

VoxelMap::Change VoxelMap::take(VoxelGrid grid, const std::vector<VoxelMask>& masks) {
  const double size = grid.size();
  Change change;
  // The occupied voxels, including unknown ones if the options count these.
  BitsOfTiles occupied;
  occupied.reserve(grid.tiles_.size());
  for (const auto& [key, tile] : grid.tiles_)
    if (tile.occupied.any()) occupied.emplace(key, tile.occupied);
  if (options_.unknown == UnknownSpace::kOccupied && !grid.tiles_.empty()) {
    Vector3i first = VoxelGrid::tileOf(grid.tiles_.begin()->first), last = first;
    for (const auto& [key, tile] : grid.tiles_) {
      first = first.cwiseMin(VoxelGrid::tileOf(key));
      last = last.cwiseMax(VoxelGrid::tileOf(key));
    }
    const Vector3i count = last - first;
    if (double(count.x() + 1) * (count.y() + 1) * (count.z() + 1) > double(options_.max_tiles))
      throw std::runtime_error("a map whose unknown space is more than " + std::to_string(options_.max_tiles) +
                               " tiles");
    for (Vector3i t = first; t.z() <= last.z(); ++t.z())
      for (t.y() = first.y(); t.y() <= last.y(); ++t.y())
        for (t.x() = first.x(); t.x() <= last.x(); ++t.x()) occupied[VoxelGrid::keyOf(t)] |= ~grid.known(t);
  }
  for (const VoxelMask& mask : masks) {
    if (options_.unknown != UnknownSpace::kOccupiedNear) break;
    const double reach = mask.radius + options_.near_distance;
    for (const Vector3i& t : tilesNear(mask.center_M, reach, size, options_.max_tiles)) {
      const Bits known = grid.known(t);
      Bits& bits = occupied[VoxelGrid::keyOf(t)];
      visitNear(t, size, mask.center_M, reach, [&](std::size_t i, const Vector3d& p_M) {
        if (!known[i] && mask.distance(p_M) <= options_.near_distance) bits.set(i);
      });
    }
  }
  // Remove what the robot itself fills.
  const double pad = options_.padding + 0.5 * size;
  for (const VoxelMask& mask : masks) {
    checkCancelled();
    const double reach = mask.radius + pad;
    for (const Vector3i& t : tilesNear(mask.center_M, reach, size, options_.max_tiles)) {
      const auto found = occupied.find(VoxelGrid::keyOf(t));
      if (found == occupied.end()) continue;
      const auto tile = grid.tiles_.find(found->first);
      const Bits seen = tile != grid.tiles_.end() ? tile->second.occupied : Bits();
      visitNear(t, size, mask.center_M, reach, [&](std::size_t i, const Vector3d& p_M) {
        if (!found->second[i] || (seen[i] && mask.only_unknown)) return;
        const double distance = mask.distance(p_M);
        const bool by_surface = mask.surface_distance && (distance > 0.0 || (seen[i] && mask.is_open));
        if (distance > pad || (by_surface && mask.surface_distance(p_M) > pad)) return;
        found->second.reset(i);
        ++change.masked;
      });
    }
  }

  // Find the tiles that differ from the last map, by the blocks that they are made of.
  const bool is_another = size != size_;
  std::vector<std::uint64_t> keys;
  for (const auto& [key, bits] : occupied) {
    change.occupied += bits.count();
    if (bits.any()) keys.push_back(key);
  }
  if (keys.size() > options_.max_tiles)
    throw std::runtime_error("a map of more than " + std::to_string(options_.max_tiles) + " tiles");
  std::sort(keys.begin(), keys.end());
  std::unordered_set<std::uint64_t> changed;
  for (const std::uint64_t key : keys) {
    const auto known = tiles_.find(key);
    if (is_another || known == tiles_.end() || known->second->own != occupied.at(key)) changed.insert(key);
  }
  for (const auto& [key, built] : tiles_) {
    const auto now = occupied.find(key);
    if (now == occupied.end() || now->second.none()) changed.insert(key);
  }
  const auto isNearChange = [&](const Vector3i& tile) {
    for (int i = 0; i < 27; ++i) {
      const Vector3i other = tile + Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (other.minCoeff() >= 0 && changed.count(VoxelGrid::keyOf(other)) > 0) return true;
    }
    return false;
  };
  struct Made {
    std::shared_ptr<const Built> built;
    BodyDescription body;
    std::optional<DistanceField> field;  // if the tile is new
  };
  std::vector<Made> made(keys.size());
  const CancelPoint cancel;
  parallelFor(std::size_t{0}, keys.size(), [&](std::size_t k) {
    cancel.check();
    const Vector3i tile = VoxelGrid::tileOf(keys[k]);
    const auto known = tiles_.find(keys[k]);
    if (!isNearChange(tile)) {
      made[k].built = known->second;
      return;
    }
    auto built = std::make_shared<Built>();
    built->own = occupied.at(keys[k]);
    built->block = blockOf(tile, occupied, VoxelGrid::keyOf);
    if (!is_another && known != tiles_.end() && known->second->block.occupied == built->block.occupied) {
      made[k].built = known->second;
      return;
    }
    const VoxelLattice place{cornerOf((kTile * tile).array() - 1, size), size};
    GeometryDescription geometry;
    geometry.shape = std::make_shared<const TriangleMesh>(voxelSurface(built->block, place));
    geometry.source = name_;
    geometry.watertight_voxels = true;
    geometry.cell_size = 0.5 * size;
    made[k].field = voxelField(built->block, place, options_.band);
    BodyDescription& body = made[k].body;
    body.name = nameOf(name_, tile);
    body.frame = frame_;
    body.is_world = true;
    body.map = name_;
    body.geometry.push_back(std::move(geometry));
    made[k].built = std::move(built);
  });
  std::unordered_map<std::uint64_t, std::shared_ptr<const Built>> tiles;
  tiles.reserve(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    tiles.emplace(keys[k], std::move(made[k].built));
    if (!made[k].field) continue;
    change.made.push_back(std::move(made[k].body));
    change.fields.push_back(std::move(*made[k].field));
  }
  for (const auto& [key, built] : tiles_)
    if (tiles.count(key) == 0) change.removed.push_back(nameOf(name_, VoxelGrid::tileOf(key)));
  tiles_ = std::move(tiles);
  size_ = size;
  return change;
}

}  // namespace sdf_ccd
