#pragma once

#include <vector>

#include "common/settings/settings_reader.h"
#include "robot/world_shapes.h"

namespace sdf_ccd {

/// The parameter `world`: a list of objects (config/monitor.yaml), or a group with MoveIt's `collision_objects`, of
/// which header/frame_id, id, pose, primitives, planes, meshes and their poses are read; `operation` must be ADD if it
/// is set, and other members are ignored.
/// @throws std::runtime_error naming the parameter and its value.
std::vector<WorldObject> readWorld(SettingsReader& reader);

}  // namespace sdf_ccd
