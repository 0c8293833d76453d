#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "monitor/scene_cost.h"
#include "ros/parameters/parameters.h"
#include "sdf_ccd/robot/unreachable_pairs.h"

namespace sdf_ccd {

/// The robot and its world, before anything is built.
struct DescribedScene {
  std::shared_ptr<const RobotModel> robot;
  SceneDescription scene;
  std::string root_frame;                    ///< the tf frame of the robot's root link
  std::string tf_prefix;                     ///< of all links' frames: empty, or ending in a slash
  std::string base_joint;                    ///< the SRDF's virtual joint of the root link; empty if there is none
  std::string fixed_frame;                   ///< without leading slash
  std::string tiles_begin;                   ///< what names of a live map's tiles begin with; empty: there is none
  std::vector<PairRule> kept;                ///< pairs that are to be checked whatever they do
  bool leave_out_overlapping = true;         ///< as MonitorParameters
  std::vector<UnreachablePair> unreachable;  ///< left out, as long as joints keep to their limits
  std::vector<std::string> warnings;
};

/// package://, file:// and paths from the disk; http:// and https:// where they are allowed (fetchHttp()).
/// @param packages   finds a package's folder.
/// @param directory  that relative paths start from; empty: there are none.
ResourceLoader makeResourceLoader(const PackageFinder& packages, const std::string& directory, bool allow_http);

/// Reads URDF, SRDF, world objects and the OctoMap. A link or object whose mesh cannot be read is there, with the
/// reason in BodyDescription::failure.
/// @throws std::exception if the URDF or the SRDF cannot be read, two bodies share a name, or one has a name that a
/// live map's tile may get.
DescribedScene describeScene(const MonitorParameters& parameters, const ResourceLoader& loader);

/// @throws std::invalid_argument if a body's name is one that a live map's tiles may get.
void requireNoTile(const std::string& body, const std::string& tiles_begin);

/// What the scene needs, and what building that is expected to cost. @throws as affordableCost() of the core.
ScenePlan affordablePlan(const DescribedScene& described, const BodyOptions& options);

/// Builds what is planned with the same options; then pairs that overlap always are left out, if they are to be.
/// @param progress  called with the body's name and the share of all bodies done.
std::shared_ptr<const Scene> buildDescribed(const DescribedScene& described, const ScenePlan& plan,
                                            const BodyOptions& options,
                                            const std::function<void(const std::string&, double)>& progress);

}  // namespace sdf_ccd
