#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "sdf_ccd/model/scene_description.h"
#include "voxel_grid.h"

namespace sdf_ccd {

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
    std::vector<BodyDescription> made;  ///< tiles that are new or have changed: one mesh with its field each
    std::vector<std::string> removed;   ///< names of tiles in which nothing is occupied any more
    std::size_t occupied = 0;           ///< voxels, without masked ones
    std::size_t masked = 0;
  };

  /// Replaces the last map. If it throws, the last one stays.
  /// @throws std::runtime_error if it has too many tiles; Cancelled.
  Change take(const VoxelGrid& grid, const std::vector<VoxelMask>& masks);

 private:
  struct Tile;
  using Tiles = std::unordered_map<TileKey, std::shared_ptr<const Tile>>;
  struct Made;

  /// Tiles in which something is occupied; made anew where voxels in or around them differ from the last tiles.
  std::vector<Made> make(const TileMap& occupied, double size, const Tiles& last) const;
  Made make(TileKey key, const TileMap& occupied, double size) const;

  std::string name_, frame_;
  VoxelMapOptions options_;
  double size_ = 0.0;  // of the last map's voxels [m]
  Tiles tiles_;        // those in which something is occupied
};

}  // namespace sdf_ccd
