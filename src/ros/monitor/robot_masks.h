#pragma once

#include "monitor/map/voxel_map.h"
#include "ros/monitor/robot_in_map.h"

namespace sdf_ccd {

/// The parts of a map that the robot and the objects attached to it fill. Logs, once, that a body has no field and
/// therefore no mask. The masks refer to the world.
std::vector<VoxelMask> robotMasks(const CheckedWorld& world, const std::vector<BodyInMap>& bodies);

}  // namespace sdf_ccd
