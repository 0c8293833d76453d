#pragma once

#include <string>
#include <vector>

#include "monitor/map/voxel_mask.h"

namespace sdf_ccd {

struct SceneDescription;

/// Pose of a body of the robot, or of an object attached to it, in a map.
struct BodyInMap {
  std::size_t body = 0;                      ///< index in the scene
  Isometry3d X_BM = Isometry3d::Identity();  ///< of the map's frame in the body's
  bool is_at_stamp = false;                  ///< at the map's stamp; else at the newest time that is known
  bool was_elsewhere = false;                ///< at the stamp, as it was attached later
};

/// The parts of a map that the robot and the objects attached to it fill. The masks refer to the scene.
struct RobotMasks {
  std::vector<VoxelMask> masks;
  std::string without_field;  ///< the first body that has no mask, as it has no field; empty if there is none
};
RobotMasks robotMasks(const Scene& scene, const SceneDescription& description, const std::vector<BodyInMap>& bodies);

}  // namespace sdf_ccd
