#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd {

/// The files that a request over the network may name: those below certain folders, after links are resolved.
class RequestFiles {
 public:
  /// @param roots   folders, which need not exist yet; empty: no file may be named.
  /// @param loader  of package://, http:// and https://, which need not be below the roots.
  RequestFiles(std::vector<std::string> roots, ResourceLoader loader);

  /// The file's path, without links. @throws std::runtime_error if it is below none of the roots.
  std::string path(const std::string& file) const;

  /// The content of a URI or path, see ResourceLoader.
  Resource resource(const std::string& uri) const;

 private:
  std::vector<std::string> roots_;
  ResourceLoader loader_;
};

}  // namespace sdf_ccd
