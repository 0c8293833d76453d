#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// What of a map is not known to be free or occupied.
enum class UnknownSpace {
  kFree,
  kOccupied,      ///< within the box of what is known
  kOccupiedNear,  ///< where it is near what the map is for: VoxelMapOptions::near_distance
};

struct VoxelMapOptions {
  double band = 0.0;  ///< of the tiles' fields [m]; see BodyOptions
  UnknownSpace unknown = UnknownSpace::kFree;
  double near_distance = 0.5;  ///< [m]
  double padding = 0.03;  ///< voxels whose centres are nearer than this and half a voxel to a VoxelMask are free [m]
  std::size_t max_voxels = 20'000'000;  ///< occupied ones
  std::size_t max_tiles = 20'000;
};

/// What fills voxels that do not count: a robot's own links.
struct VoxelMask {
  Vector3d center_M = Vector3d::Zero();                 ///< of a ball that holds it, in the map's frame M [m]
  double radius = 0.0;                                  ///< [m]
  std::function<double(const Vector3d& p_M)> distance;  ///< to it, no more than the true one [m]; from several threads
};

/// An octree's leaves, as they come: whole cubes of voxels, free or occupied.
class VoxelGrid {
 public:
  static constexpr int kTile = 18;  ///< voxels along a tile's side
  using Bits = std::bitset<std::size_t{kTile} * kTile * kTile>;
  struct Tile {
    Bits occupied, known;
  };

  /// @param size  of a voxel [m]. @throws std::invalid_argument if it is not positive and finite.
  VoxelGrid(double size, const VoxelMapOptions& options);
  VoxelGrid(VoxelGrid&&) = default;
  VoxelGrid& operator=(VoxelGrid&&) = default;

  /// From a serialised OctoMap: octomap_msgs/Octomap's `data`, `id` and `binary`.
  /// @throws std::runtime_error with the reason: of another type than OcTree and ColorOcTree, damaged, too large.
  void addOctree(const std::int8_t* data, std::size_t bytes, const std::string& type, bool is_binary);

  /// A cube of voxels from `low` on; counted as in OctreeLeaf: voxel 32768 begins at the origin.
  /// @throws std::runtime_error if there are more than the options allow; std::invalid_argument if a free one of more
  /// tiles than that is no leaf of an octree: its side a power of two, its place a multiple of that.
  void add(const Vector3i& low, int side, bool is_occupied);

  double size() const { return size_; }
  std::size_t occupied() const { return occupied_; }

 private:
  friend class VoxelMap;
  using Key = std::uint64_t;
  static Key keyOf(const Vector3i& tile);
  static Vector3i tileOf(Key key);
  Tile& tileAt(const Vector3i& tile);
  void addLargeFree(const Vector3i& low, int side);
  std::optional<Key> largeFreeAt(const Vector3i& voxel) const;
  Bits known(const Vector3i& tile) const;

  double size_;
  VoxelMapOptions options_;
  bool keeps_known_;
  std::size_t occupied_ = 0;
  std::unordered_map<Key, Tile> tiles_;
  std::unordered_set<Key> large_free_;  // leaves of more tiles than may be, by level and place
  int lowest_large_ = 16;               // level of the smallest of these
  Key last_ = ~Key{0};
  Tile* last_tile_ = nullptr;
};

/// A map of voxels that changes, as bodies of the world: tiles of 18 voxels a side that overlap by one, each with a
/// field of its own that is never changed. A new map makes those tiles anew that differ, and shares the rest (Xu &
/// Barbič, §6, name dynamic octrees as what their fields lack).
///
/// Tiles overlap, so that what is inside a wall is as deep inside one of them as in the wall, to a voxel; where two
/// overlap, both bear force.
class VoxelMap {
 public:
  /// @param name   of the map; its tiles are named "name/x_y_z", and say that they are its (BodyDescription::map).
  /// @param frame  that carries it.
  VoxelMap(std::string name, std::string frame, const VoxelMapOptions& options);

  struct Change {
    std::vector<BodyDescription> made;  ///< tiles that are new or have changed: a mesh each
    std::vector<DistanceField> fields;  ///< of each, for WorldEditor::provide()
    std::vector<std::string> removed;   ///< names of tiles in which nothing is occupied any more
    std::size_t occupied = 0;           ///< voxels, without what is masked
    std::size_t masked = 0;
  };

  /// Takes a map in the place of the last one. If it throws, the last one stays.
  /// @throws std::runtime_error if it has too many tiles; Cancelled.
  Change take(VoxelGrid grid, const std::vector<VoxelMask>& masks);

 private:
  struct Built;
  std::string name_, frame_;
  VoxelMapOptions options_;
  double size_ = 0.0;
  std::unordered_map<std::uint64_t, std::shared_ptr<const Built>> tiles_;
};

}  // namespace sdf_ccd
