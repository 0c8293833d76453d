#pragma once

#include <geometry_msgs/Pose.h>

#include "robot_monitor/request_permissions.h"
#include "sdf_ccd/SceneChange.h"

namespace sdf_ccd {

/// Whether the change has a pose: any number of it is not zero.
bool hasPose(const SceneChange& message);

/// @param name  of the pose, for errors.
/// @throws std::invalid_argument if a number is not finite or too large, or the orientation is not a unit quaternion.
Isometry3d poseIn(const geometry_msgs::Pose& pose, const std::string& name);

bool hasShapes(const SceneChange& message);

/// The shapes of a message, without its OctoMap. Meshes in it are copied; mesh resources are named, not loaded.
/// @param triangles  number that the meshes in the message may contain together.
/// @throws std::invalid_argument with the shape and its error.
std::vector<WorldShape> shapesIn(const SceneChange& message, const RequestLimits& limits, std::size_t triangles);

}  // namespace sdf_ccd
