#pragma once

#include <vector>

#include "ros/parameters/parameter_reader.h"
#include "ros/parameters/world_object.h"

namespace sdf_ccd {

/// A pose as parameters have it: `xyz` and `rpy` (roll, pitch, yaw).
Isometry3d readPose(ParameterReader& reader);

/// The parameter `world`: a list of our own objects (config/monitor.yaml), or a group that holds MoveIt's
/// `collision_objects`, of which header/frame_id, id, pose, primitives, planes, meshes and their poses count;
/// `operation` must be ADD if it is there, and what else is there is not read.
/// @throws ParameterError naming the parameter and its value.
std::vector<WorldObject> readWorld(ParameterReader& reader);

}  // namespace sdf_ccd
