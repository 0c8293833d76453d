#pragma once

#include "robot_monitor/changing_scene.h"
#include "ros/tf/tf_history.h"
#include "ros/world/message_object.h"
#include "ros/world/request_files.h"

namespace sdf_ccd {

/// Resources for changes of the scene.
struct ChangeSources {
  const TfHistory& history;
  const RequestFiles& files;
  RequestLimits limits;
  std::size_t triangles = RequestLimits().triangles;  ///< number that the call may still contain
  std::vector<std::string> warnings;                  ///< receives notes for the caller
  ros::Time now = {};                                 ///< of the call
};

/// @throws std::exception with the reason, also if it is not permitted; the scene must then be discarded.
void apply(const SceneChange& change, ChangeSources& sources, ChangingScene& scene);

/// The world's objects in MoveIt's .scene format, in the fixed frame. Maps, which it cannot hold, are left out with a
/// warning.
/// @throws std::exception if tf does not know an object's pose, or an object's name cannot be saved.
std::string sceneText(const ChangingScene& scene, const TfHistory& history, std::vector<std::string>& warnings);

}  // namespace sdf_ccd
