#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/robot/resource.h"
#include "sdf_ccd/robot/robot_model.h"
#include "sdf_ccd/robot/srdf.h"
#include "sdf_ccd/scene/scene_description.h"

namespace sdf_ccd {

struct RobotSceneOptions {
  bool check_adjacent = false;  ///< also check links with one joint between them
};

/// The bodies of a robot: one per link with collision elements, its meshes loaded, scaled and oriented.
///
/// A bad or missing mesh costs that link alone: BodyDescription::failure names it. Rigidly joined, adjacent and SRDF
/// pairs are disabled, and those out of reach of each other for every joint position.
/// @param warnings  what a user should know, a line each.
SceneDescription describeRobot(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                               const RobotSceneOptions& options, std::vector<std::string>& warnings);

/// Disables pairs of a world object that never moves relative to the robot's root link and a link that cannot
/// reach it. Call it when the objects are in `scene`.
void disableUnreachable(const RobotModel& robot, SceneDescription& scene);

}  // namespace sdf_ccd
