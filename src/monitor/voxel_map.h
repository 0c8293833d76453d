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

/// A solid whose voxels are ignored: one of the robot's own links.
struct VoxelMask {
  Vector3d center_M = Vector3d::Zero();                 ///< of a ball that contains it, in the map's frame M [m]
  double radius = 0.0;                                  ///< [m]
  std::function<double(const Vector3d& p_M)> distance;  ///< lower bound of the distance to it [m]; must be thread-safe
  /// The same to its surface alone, and exact: far from a surface `distance` may be far too low. Null if `distance` is
  /// exact itself.
  std::function<double(const Vector3d& p_M)> surface_distance;
  bool is_open = false;  ///< what is occupied inside is not ignored: the surface has openings, or may have cavities
  bool only_unknown = false;  ///< ignores only unknown voxels: when the map was made, the solid may have been elsewhere
};

/// Collects the leaves of an octree: cubes of voxels, free or occupied.
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

  /// Adds a cube of voxels with the lowest voxel `low`, indexed as in OctreeLeaf: voxel 32768 begins at the origin.
  /// @throws std::runtime_error if the options' limits are exceeded; std::invalid_argument if a free cube of more than
  /// max_tiles tiles is no leaf of an octree: its side must be a power of two, its lowest voxel a multiple of that.
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
  std::unordered_set<Key> large_free_;  // free leaves of more than max_tiles tiles, by level and position
  int lowest_large_ = 16;               // level of the smallest of these
  Key last_ = ~Key{0};
  Tile* last_tile_ = nullptr;
};

/// A changing voxel map, as bodies of the world: tiles of 18 voxels a side that overlap by one voxel, each with its own
/// immutable field. A new map rebuilds only the tiles that differ, and shares the others (Xu & Barbič, §6, name
/// dynamic octrees as what their fields lack).
///
/// Because tiles overlap, the depth of a point inside a wall is that within one of the tiles, to a voxel; where two
/// tiles overlap, both bear force.
class VoxelMap {
 public:
  /// @param name   of the map; its tiles are named "name/x_y_z", with the map's name in BodyDescription::map.
  /// @param frame  the tf frame that carries the map.
  VoxelMap(std::string name, std::string frame, const VoxelMapOptions& options);

  struct Change {
    std::vector<BodyDescription> made;  ///< tiles that are new or have changed: one mesh each
    std::vector<DistanceField> fields;  ///< of each, for WorldEditor::provide()
    std::vector<std::string> removed;   ///< names of tiles in which nothing is occupied any more
    std::size_t occupied = 0;           ///< voxels, without masked ones
    std::size_t masked = 0;
  };

  /// Replaces the last map. If it throws, the last one stays.
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
