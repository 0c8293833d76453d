#include "ros/monitor/robot_masks.h"

#include <ros/console.h>

#include "monitor/map/voxel_mask.h"

namespace sdf_ccd {

std::vector<VoxelMask> robotMasks(const CheckedWorld& world, const std::vector<BodyInMap>& bodies) {
  std::vector<VoxelMask> masks;
  for (const BodyInMap& in_map : bodies) {
    const Body& body = world.scene().bodies[in_map.body];
    const BodyDescription& description = world.description().bodies[in_map.body];
    if (!body.failure.empty() || description.geometry.empty()) continue;
    if (auto mask = maskOf(body, description, in_map.X_BM)) {
      mask->only_unknown = !in_map.is_at_stamp;
      mask->is_guess = !in_map.is_at_stamp && !in_map.was_elsewhere;
      masks.push_back(std::move(*mask));
    } else {
      ROS_WARN_ONCE("Voxels that %s fills count, as it has no field", body.name.c_str());
    }
  }
  return masks;
}

}  // namespace sdf_ccd
