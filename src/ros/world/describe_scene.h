#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "robot_monitor/changing_scene.h"
#include "robot_monitor/overlapping_pairs.h"
#include "ros/parameters/parameters.h"
#include "ros/tf/robot_frames.h"

namespace sdf_ccd {

/// The robot and its world, before anything is built.
struct DescribedScene {
  std::shared_ptr<const RobotModel> robot;
  SceneDescription scene;
  std::string root_frame;              ///< tf frame of the robot's root link
  std::string tf_prefix;               ///< of all links' frames: empty, or ends in a slash
  std::string base_joint;              ///< the SRDF's virtual joint of the root link; empty if there is none
  std::string fixed_frame;             ///< without leading slash
  std::string tiles_begin;             ///< prefix of the names of a live map's tiles; empty: there is no live map
  OverlapRule overlap_rule;            ///< for pairs of links
  std::vector<PairDecision> overlaps;  ///< found by buildDescribed()
  std::vector<std::string> warnings;

  RobotFrames frames() const { return {*robot, tf_prefix}; }
};

/// Reads URDF, SRDF, world objects and the OctoMap. A link or object whose mesh cannot be read is included, with the
/// reason in BodyDescription::failure.
/// @throws std::exception if the URDF or the SRDF cannot be read, two bodies have the same name, or one has a name that
/// is reserved for a live map's tiles.
DescribedScene describeScene(const MonitorParameters& parameters, const ResourceLoader& loader);

/// What requests change the scene from. @param scene  that was built.
StartUpScene startUpScene(const DescribedScene& described, const MonitorParameters& parameters,
                          const SceneDescription& scene);

/// Builds the planned scene, with the same options, then sets aside pairs that overlap at rest, as the rule says.
/// @param progress  called with the body's name and the fraction of all bodies done.
std::shared_ptr<const Scene> buildDescribed(DescribedScene& described, const ScenePlan& plan,
                                            const BodyOptions& options,
                                            const std::function<void(const std::string&, double)>& progress);

}  // namespace sdf_ccd
