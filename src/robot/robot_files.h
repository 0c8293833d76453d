#pragma once

#include <string>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// The content of a text file. @throws std::runtime_error that names it, if it cannot be read or is empty.
std::string readTextFile(const std::string& path);

/// A robot as its files have it.
struct LoadedRobot {
  RobotModel model;
  std::string srdf_text;  ///< empty if there is none
  Srdf srdf;
  ResourceLoader loader;  ///< of its meshes: relative names are beside the URDF
};

/// Reads a robot. @param srdf  empty: none.
/// @throws std::runtime_error that names the file, if one cannot be read.
LoadedRobot loadRobot(const std::string& urdf, const std::string& srdf);

/// Reads meshes as loadLocalResource() does, with packagesFromEnvironment().
ResourceLoader localLoader(const std::string& base_directory);

}  // namespace sdf_ccd
