#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "sdf_ccd/body.h"
#include "voxel_memory.h"
#include "voxel_objects.h"

namespace sdf_ccd {

/// A changing voxel map, as bodies of the world: tiles of 18 voxels a side that overlap by one voxel, each with its own
/// immutable field. A new map rebuilds only the tiles that differ, and shares the others (Xu & Barbič, §6, name
/// dynamic octrees as what their fields lack).
///
/// Voxels in objects of the scene are tiles of their own (TileObject).
///
/// Because tiles overlap, the depth of a point inside a wall is that within one of the tiles, to a voxel; where two
/// tiles overlap, both bear force.
class VoxelMap {
 public:
  /// @param name   of the map; its tiles are named "name/x_y_z", or "name/x_y_z/object", with the map's name in
  /// BodyDescription::map.
  /// @param frame  the tf frame that carries the map.
  VoxelMap(std::string name, std::string frame, const VoxelMapOptions& options);

  struct Change {
    std::vector<BodyDescription> made;  ///< tiles that are new or have changed: one mesh with its field each
    std::vector<std::string> removed;   ///< names of tiles in which nothing is occupied any more
    TileObjects objects;                ///< of all tiles whose voxels are in objects
    std::size_t occupied = 0;           ///< voxels, without masked ones
    std::size_t masked = 0;
    std::size_t unproven = 0;    ///< VoxelMemory::Seen::unproven
    std::size_t unseen = 0;      ///< VoxelMemory::Seen::unseen
    std::size_t forgotten = 0;   ///< VoxelMemory::Seen::forgotten
    std::size_t in_objects = 0;  ///< of the occupied ones: those that are judged as objects of the scene
  };

  /// The robot and the objects of the scene in a map.
  struct Surroundings {
    std::vector<VoxelMask> masks = {};  ///< of the robot's bodies
    std::vector<ObjectMask> objects = {};
    bool is_robot_known = true;  ///< see VoxelMemory::see()
    bool is_again = false;       ///< the map is the last one
  };

  /// Has a map record what is needed of its free space; before its leaves are added.
  void watch(VoxelGrid& grid) const;

  /// Follows the last map by another one of voxels of the same size. If it throws, the last one stays.
  /// @throws std::runtime_error if it has too many tiles; Cancelled.
  Change update(const VoxelGrid& grid, const Surroundings& around);

  /// The last map with the objects where they are later: see VoxelObjects::judge().
  /// @return what changes; nothing of the map itself.
  Change judgeAgain(const std::vector<ObjectMask>& objects);

  /// Whether judgeAgain() may change something about this object, because of where it is now.
  bool isInMap(const std::string& object, std::uint64_t declared) const { return objects_.mayHave(object, declared); }

  /// Whether an object of another number than this was judged, or no object of the name.
  bool isNew(const std::string& object, std::uint64_t declared) const { return objects_.isNew(object, declared); }

  /// Takes the next map for the first one: see VoxelMemory.
  void forget() { memory_.forget(); }

 private:
  struct Tile;
  using Tiles = std::unordered_map<TileKey, std::shared_ptr<const Tile>>;
  struct Made;
  struct Layer {  // tiles of voxels that are judged as one object
    std::uint64_t declared = 0;
    Tiles tiles;  // those in which something is occupied
  };
  using Layers = std::map<std::string, Layer>;  // by object; "": of those in none

  Change replaceTiles(TileMap visible, const VoxelObjects& objects, double size);
  /// Tiles in which something is occupied; made anew where voxels in or around them differ from the last tiles.
  std::vector<Made> make(const TileMap& occupied, double size, const Tiles& last) const;
  Made make(TileKey key, const TileMap& occupied, double size) const;

  std::string name_, frame_;
  VoxelMapOptions options_;
  double size_ = 0.0;  // of the last map's voxels [m]
  VoxelMemory memory_;
  TileMap visible_;  // the last map's voxels without masked ones
  VoxelObjects objects_;
  Layers layers_;
};

}  // namespace sdf_ccd
