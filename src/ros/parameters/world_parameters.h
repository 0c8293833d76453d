#pragma once

#include <vector>

#include "ros/parameters/parameter_reader.h"
#include "ros/parameters/world_object.h"

namespace sdf_ccd {

/// A pose given by the parameters `xyz` and `rpy` (roll, pitch, yaw).
Isometry3d readPose(ParameterReader& reader);

/// The parameter `world`: a list of objects (config/monitor.yaml), or a group with MoveIt's `collision_objects`, of
/// which header/frame_id, id, pose, primitives, planes, meshes and their poses are read; `operation` must be ADD if it
/// is set, and other members are ignored.
/// @throws ParameterError naming the parameter and its value.
std::vector<WorldObject> readWorld(ParameterReader& reader);

}  // namespace sdf_ccd
