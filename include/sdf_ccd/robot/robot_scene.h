#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/robot/resource.h"
#include "sdf_ccd/robot/robot_model.h"
#include "sdf_ccd/robot/srdf.h"

namespace sdf_ccd {

struct RobotSceneOptions {
  bool check_adjacent = false;  ///< also check links with one joint between them
};

/// The bodies of a robot: one per link with collision elements, named after the link and in its frame. Every mesh is
/// read once and scaled; links that use it alike share it.
///
/// A bad or missing mesh, or a collision element that cannot be read, costs that link alone: BodyDescription::failure
/// says "link forearm: package://…: no such package", and its geometry is empty. Left out are, in this order, pairs
/// that are rigidly joined, disabled by the SRDF, adjacent (unless asked for, or enabled by the SRDF by name), and out
/// of reach of each other for every joint position by RobotModel::reach() between balls around their geometry. What
/// that rests on must be watched: unreachablePairs().
/// @param warnings  what else a user should know, a line each: files found under another spelling, an SRDF that names
/// links the robot has not. Failures are not repeated here.
SceneDescription describeRobot(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                               const RobotSceneOptions& options, std::vector<std::string>& warnings);

/// Disables pairs of a world object and a link, where the object's frame is the robot's root or rigidly joined to it:
/// links that cannot reach it, and links that are rigidly joined to the root themselves. Call it when the objects are
/// in `scene`.
void disableUnreachable(const RobotModel& robot, SceneDescription& scene);

}  // namespace sdf_ccd
