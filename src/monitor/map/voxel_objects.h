#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "voxel_mask.h"
#include "voxel_tiles.h"

namespace sdf_ccd {

/// The object as which a tile of a map is judged: it is not checked as long as that object exists, with that number.
struct TileObject {
  std::string object;
  std::uint64_t declared = 0;  ///< ObjectMask::declared
};
using TileObjects = std::map<std::string, TileObject>;  ///< by the tile's name

/// The voxels of a map that are judged as objects of the scene, because they lie in one, or within half of a voxel's
/// diagonal of it: a pair with them follows the object's rule, as the object itself is where they are.
///
/// An object of the world has the voxels in which it is when a map is made. Between maps, voxels only leave it, when it
/// moves away from them. An attached object is itself checked against the map, so it must not free what the robot
/// pushes it into: it only keeps voxels that it had before it was attached, or has where it is attached. To attach it
/// anew, as by who tracks its pose in the hand, gains it nothing.
class VoxelObjects {
 public:
  struct Found {
    std::uint64_t declared = 0;
    bool is_attached = false;
    TileMap voxels;  ///< may be empty
  };

  /// @param visible  the map's voxels that count.
  /// @param objects  all of the scene; what is not among them has no voxels any more.
  /// @param is_new_map  else it is the last one, with objects where they are later.
  /// @return whether the voxels of some object are others now.
  bool judge(const TileMap& visible, double size, const std::vector<ObjectMask>& objects, bool is_new_map);

  /// By object.
  const std::map<std::string, Found>& found() const { return found_; }

  bool isNew(const std::string& object, std::uint64_t declared) const {
    const auto known = found_.find(object);
    return known == found_.end() || known->second.declared != declared;
  }

  bool mayHave(const std::string& object, std::uint64_t declared) const {
    return isNew(object, declared) || !found_.at(object).voxels.empty();
  }

 private:
  std::map<std::string, Found> found_;
};

}  // namespace sdf_ccd
