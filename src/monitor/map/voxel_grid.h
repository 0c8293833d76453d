#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "voxel_mask.h"
#include "voxel_tiles.h"

namespace sdf_ccd {

/// How to treat the space that a map knows to be neither free nor occupied.
enum class UnknownSpace {
  kFree,
  kOccupied,      ///< occupied within the bounding box of known space
  kOccupiedNear,  ///< occupied within VoxelMapOptions::near_distance of a VoxelMask
};

struct VoxelMapOptions {
  double band = 0.0;  ///< of the tiles' fields [m]; see BodyOptions
  UnknownSpace unknown = UnknownSpace::kFree;
  double near_distance = 0.5;  ///< [m]
  double padding = 0.03;  ///< voxels are free if their centres may be within this plus half a voxel of a VoxelMask [m]
  std::size_t max_voxels = 20'000'000;  ///< occupied ones
  std::size_t max_tiles = 20'000;
};

/// Collects the leaves of an octree: cubes of voxels, free or occupied.
class VoxelGrid {
 public:
  /// @param size  of a voxel [m]. @throws std::invalid_argument if it is not positive and finite.
  VoxelGrid(double size, const VoxelMapOptions& options);
  VoxelGrid(VoxelGrid&&) = default;
  VoxelGrid& operator=(VoxelGrid&&) = default;

  /// From a serialised OctoMap: octomap_msgs/Octomap's `data`, `id` and `binary`.
  /// @throws std::runtime_error with the reason: of another type than OcTree and ColorOcTree, damaged, too large.
  void addOctree(const std::int8_t* data, std::size_t bytes, const std::string& type, bool is_binary);

  /// Adds a cube of voxels with the lowest voxel `low`, indexed as in OctreeLeaf: voxel 32768 begins at the origin.
  /// @throws std::runtime_error if the options' limits are exceeded; std::invalid_argument if a free cube of more than
  /// max_tiles tiles is no leaf of an octree: its side must be a power of two, its lowest voxel a multiple of that.
  void add(const Vector3i& low, int side, bool is_occupied);

  double size() const { return size_; }                    ///< of a voxel [m]
  std::size_t occupiedCount() const { return occupied_; }  ///< voxels

  /// Has free space recorded in these tiles; to be called before leaves are added. See clearFree().
  void watch(const TileMap& tiles);

  /// Removes voxels that this map shows as free, of tiles that are watched.
  void clearFree(TileMap& voxels) const;

  struct Tile {
    TileBits occupied, known;
  };
  bool hasFree() const { return has_free_; }  ///< whether it shows any free space
  /// Tiles with occupied voxels or, unless unknown space is free, known ones.
  const std::unordered_map<TileKey, Tile>& tiles() const { return tiles_; }

  struct Occupied {
    TileMap tiles;           ///< what counts
    TileMap hidden;          ///< voxels that the map shows as occupied, but that masks hide
    TileMap unsure;          ///< of those that count and are not remembered: may be the robot's (VoxelMask::is_guess)
    std::size_t masked = 0;  ///< hidden voxels, with unknown ones
  };

  /// The occupied voxels, with unknown ones if the options count these, without those that are hidden by masks.
  /// @param remembered  also count, and no mask hides them.
  /// @throws std::runtime_error if the options' limits are exceeded; Cancelled.
  Occupied occupied(const std::vector<VoxelMask>& masks, const TileMap& remembered = {}) const;

 private:
  Tile& tileAt(const Vector3i& tile);
  void addFree(const Vector3i& low, int side);
  void addLargeFree(const Vector3i& low, int side);
  std::optional<std::uint64_t> largeFreeAt(const Vector3i& voxel) const;
  TileBits known(const Vector3i& tile) const;
  void addUnknown(TileMap& occupied) const;
  void addUnknownNear(const VoxelMask& mask, TileMap& occupied) const;
  void hide(const VoxelMask& mask, const TileMap& remembered, Occupied& result) const;

  double size_;
  VoxelMapOptions options_;
  bool keeps_known_, has_free_ = false;
  std::size_t occupied_ = 0;  // voxels
  TileMap free_;              // of the watched tiles
  std::unordered_map<TileKey, Tile> tiles_;
  std::unordered_set<std::uint64_t> large_free_;  // free leaves of more than max_tiles tiles, by level and position
  int lowest_large_ = 16;                         // level of the smallest of these
  TileKey last_ = ~TileKey{0};
  Tile* last_tile_ = nullptr;
};

}  // namespace sdf_ccd
