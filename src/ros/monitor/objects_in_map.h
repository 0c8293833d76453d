#pragma once

#include <optional>
#include <string>
#include <vector>

#include "monitor/map/voxel_mask.h"
#include "ros/tf/tf_history.h"
#include "ros/world/checked_world.h"

namespace sdf_ccd {

/// Where the objects of the scene are in a map, according to tf: at the map's stamp, else now, if that is known. An
/// object that was attached to a link and is new to the map is where it was at that time and still is. What moves with
/// one of the robot's frames, in the tree of tf, counts as attached.
///
/// The masks refer to the world.
class ObjectsInMap {
 public:
  /// @param frame  carries the map.
  ObjectsInMap(const TfHistory& history, const CheckedWorld& world, std::string frame)
      : history_(history), world_(world), frame_(std::move(frame)) {}

  /// Bodies of the world that are objects, by their indices.
  std::vector<std::size_t> objects() const;

  const std::string& name(std::size_t object) const { return world_.scene().bodies[object].name; }
  std::uint64_t declared(std::size_t object) const;

  /// @param stamp   0: now.
  /// @param is_new  whether a map knows nothing of an object with this name and number yet.
  std::vector<ObjectMask> masks(const ros::Time& stamp,
                                const std::function<bool(const std::string&, std::uint64_t)>& is_new) const;

 private:
  bool movesWithRobot(const std::string& frame) const;
  std::optional<ObjectMask> maskAt(std::size_t object, const ros::Time& time) const;
  std::optional<ObjectMask> graspedMask(std::size_t object, const ros::Time& attached) const;

  const TfHistory& history_;
  const CheckedWorld& world_;
  std::string frame_;
};

}  // namespace sdf_ccd
