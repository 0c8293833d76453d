#pragma once

#include <functional>
#include <string>

namespace sdf_ccd {

struct Resource {
  std::string bytes;
  std::string name;     ///< its ending tells the format
  std::string warning;  ///< e.g. "found link.STL, the URDF says link.stl"; empty if there is none
};

/// Fetches what a URI names; throws std::runtime_error, with the URI and the reason, if it cannot.
using ResourceLoader = std::function<Resource(const std::string& uri)>;

/// Directory of a ROS package, empty if there is none.
using PackageFinder = std::function<std::string(const std::string& package)>;

/// Looks below the directories of ROS_PACKAGE_PATH, as rospack does: for package.xml (its `name` counts, not the
/// folder's) and manifest.xml; not below a package, a hidden folder, `rospack_nosubdirs` or CATKIN_IGNORE (also
/// AMENT_IGNORE, COLCON_IGNORE). Of equal names the first wins. Crawls at the first question and remembers; may be
/// asked from several threads.
PackageFinder packagesFromEnvironment();

/// Reads `file://`, `package://` (also with a third slash) and plain paths (relative to `base_directory`). A file or
/// folder whose name differs only by case is taken, with a warning.
/// @throws std::runtime_error, with the URI and the reason: no such package or file, a directory, not readable, another
/// scheme, `..` in a package URI.
Resource loadLocalResource(const std::string& uri, const PackageFinder& packages, const std::string& base_directory);

}  // namespace sdf_ccd
