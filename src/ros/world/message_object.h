#pragma once

#include <geometry_msgs/Pose.h>

#include "ros/parameters/world_object.h"
#include "sdf_ccd/SceneChange.h"

namespace sdf_ccd {

/// Limits of one call; more is refused.
struct RequestLimits {
  std::size_t name = 256;  ///< characters
  std::size_t objects = kMaxObjects;
  std::size_t shapes = 1000;        ///< of an object
  std::size_t triangles = 2000000;  ///< of a call
  std::size_t rules = 1000;         ///< made by ALLOW and CHECK, in total
  std::size_t pairs = 300000;       ///< of a scene
};

/// Whether the change has a pose: any number of it is not zero.
bool hasPose(const SceneChange& message);

/// @param name  of the pose, for errors.
/// @throws std::invalid_argument if a number is not finite or too large, or the orientation is not a unit quaternion.
Isometry3d poseIn(const geometry_msgs::Pose& pose, const std::string& name);

/// @throws std::invalid_argument if the name is empty, too long or contains control characters; `what` describes it.
void requireName(const std::string& name, const std::string& what, const RequestLimits& limits);

bool hasShapes(const SceneChange& message);

/// The shapes of a message, without its OctoMap. Meshes in it are copied; mesh resources are named, not loaded.
/// @param triangles  number that the meshes in the message may contain together.
/// @throws std::invalid_argument with the shape and its error.
std::vector<WorldShape> shapesIn(const SceneChange& message, const RequestLimits& limits, std::size_t triangles);

}  // namespace sdf_ccd
