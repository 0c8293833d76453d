#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/robot/robot_model.h"
#include "sdf_ccd/scene/scene_description.h"

namespace sdf_ccd {

/// A file, as a ResourceLoader returns it.
struct Resource {
  std::string bytes;
  std::string name;     ///< its extension gives the format
  std::string warning;  ///< e.g. "found link.STL, the URDF says link.stl"; empty if there is none
};

/// Loads the file at a URI; throws std::runtime_error, with the URI and the reason, if it cannot.
using ResourceLoader = std::function<Resource(const std::string& uri)>;

/// Directory of a ROS package, empty if there is none.
using PackageFinder = std::function<std::string(const std::string& package)>;

/// Searches below the directories of ROS_PACKAGE_PATH, as rospack does, for package.xml (its `name` counts, not the
/// folder's) and manifest.xml; not below a package, a hidden folder, `rospack_nosubdirs` or CATKIN_IGNORE (also
/// AMENT_IGNORE, COLCON_IGNORE). The first of equal names wins. Searches at the first call and caches the result; can
/// be called from several threads.
PackageFinder packagesFromEnvironment();

/// Reads `file://`, `package://` (also with a third slash) and plain paths (relative to `base_directory`, and to the
/// working directory if that is empty). A file or folder whose name differs only by case is taken, with a warning.
/// @throws std::runtime_error, with the URI and the reason: no such package or file, a directory, not readable, another
/// scheme, `..` in a package URI.
Resource loadLocalResource(const std::string& uri, const PackageFinder& packages, const std::string& base_directory);

/// The parts of an SRDF file that are used. Names are not compared with any robot here.
struct Srdf {
  std::string robot;                                         ///< the robot's name in the file; may be empty
  std::vector<PairDecision> disabled;                        ///< text: "SRDF: " and the file's reason
  std::vector<std::string> disabled_by_default;              ///< links that are only checked against those of `enabled`
  std::map<std::string, std::string> virtual_joints;         ///< child link by name; parent frame and type are not used
  std::vector<std::pair<std::string, std::string>> enabled;  ///< overrides disabled_by_default, and adjacency
  std::vector<std::string> warnings;                         ///< what the text lacks that an SRDF should have
};

/// Reads `disable_collisions`, `disable_default_collisions`, `enable_collisions` and `virtual_joint`. As in MoveIt, a
/// pair that is both disabled and enabled is disabled. Beyond MoveIt, links of the first three may be named by
/// patterns (* for any text, ? for any character). Elements without names are ignored, or enable all: Srdf::warnings.
/// @param source  where the text is from, for errors; may be empty.
/// @throws std::runtime_error, with source, line and reason, if the text is no SRDF.
Srdf parseSrdf(const std::string& xml, const std::string& source = {});

/// Which pairs of links are checked.
struct RobotPairOptions {
  bool check_adjacent = false;  ///< also check links that a movable joint connects
};

/// The bodies of a robot: one per link with collision elements, with the name and the frame of the link. Every mesh is
/// read once and scaled; links that use it with the same scale share it.
///
/// A bad or missing mesh, or a collision element that cannot be read, only affects its link: BodyDescription::failure
/// says "link forearm: package://…: no such package", and its geometry is empty. Pairs may touch that are disabled by
/// the SRDF, or adjacent (unless requested, or enabled by the SRDF by name). planScene() leaves out others that are
/// rigidly joined, as setRigidRoots() finds them.
/// @param warnings  further notes for the user, one per line: files found with another spelling, an SRDF with another
/// robot's name or with links that the robot does not have; RobotModel::warnings(), Srdf::warnings. Failures are not
/// repeated here.
/// @throws std::length_error if the links are more than 300,000 pairs; Cancelled.
SceneDescription describeRobot(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                               const RobotPairOptions& options, std::vector<std::string>& warnings);

/// Sets BodyDescription::rigid_root of bodies in links' frames; of objects of the world only if the link is rigidly
/// joined to the robot's root. Call it again after bodies were added to `scene`.
/// @param prefix  of the frames of links, where these are not the links' names.
void setRigidRoots(const RobotModel& robot, SceneDescription& scene, const std::string& prefix = {});

}  // namespace sdf_ccd
