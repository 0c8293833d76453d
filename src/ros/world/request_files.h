#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd {

/// What files a request over the network may name: those below some folders, whatever links lead there.
class RequestFiles {
 public:
  /// @param roots   folders, which need not exist yet; none: no file may be named.
  /// @param loader  of package://, http:// and https://, which are not held against the roots.
  RequestFiles(std::vector<std::string> roots, ResourceLoader loader);

  /// The file's path. @throws std::runtime_error if it is below no root.
  std::string path(const std::string& file) const;

  /// What a URI or path names, as ResourceLoader.
  Resource resource(const std::string& uri) const;

 private:
  std::vector<std::string> roots_;
  ResourceLoader loader_;
};

}  // namespace sdf_ccd
