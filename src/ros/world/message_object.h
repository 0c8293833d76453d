#pragma once

#include <optional>

#include <geometry_msgs/Pose.h>

#include "ros/parameters/world_object.h"
#include "sdf_ccd/SceneChange.h"

namespace sdf_ccd {

/// What one call may hold; more is refused.
struct RequestLimits {
  std::size_t name = 256;  ///< characters
  std::size_t objects = 5000;
  std::size_t shapes = 1000;         ///< of an object
  std::size_t triangles = 2000000;   ///< of a call
  std::size_t rules = 1000;          ///< of ALLOW and CHECK, in all
  std::size_t pairs = 300000;        ///< of a scene
};

/// None if all of it is zero, as a message is that was not filled in.
/// @throws std::invalid_argument if a number is not finite or too large, or the quaternion is not unit, to a hundredth.
std::optional<Isometry3d> poseIn(const geometry_msgs::Pose& pose);

/// @throws std::invalid_argument if it is empty, too long, or holds control characters; `what` names it.
void requireName(const std::string& name, const std::string& what, const RequestLimits& limits);

/// The shapes of a message, but for an OctoMap's. Meshes in it are copied; those of resources are only named.
/// @param triangles  that are left of the call's; reduced by those of the message.
/// @throws std::invalid_argument naming the shape and what is wrong with it.
std::vector<WorldShape> shapesIn(const SceneChange& message, const RequestLimits& limits, std::size_t& triangles);

}  // namespace sdf_ccd
