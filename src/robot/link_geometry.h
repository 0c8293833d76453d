#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <urdf_model/link.h>

#include "sdf_ccd/body.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// Converts the collision elements of links to geometry. Every mesh is read once; equal URIs and scales share it.
class LinkGeometryLoader {
 public:
  LinkGeometryLoader(const ResourceLoader& loader, std::vector<std::string>& warnings)
      : loader_(loader), warnings_(warnings) {}

  /// @throws std::exception, with the reason, if an element cannot be loaded.
  std::vector<GeometryDescription> load(const urdf::Link& link);

 private:
  using Mesh = std::shared_ptr<const TriangleMesh>;

  Mesh mesh(const std::string& uri, const urdf::Vector3& scale);
  Mesh unscaledMesh(const std::string& uri);

  const ResourceLoader& loader_;
  std::vector<std::string>& warnings_;
  std::map<std::string, Mesh> unscaled_;
  std::map<std::string, std::string> failures_;  ///< reason by URI
  std::set<std::string> renamed_;                ///< URIs whose file has another name
  std::map<std::pair<std::string, std::vector<double>>, Mesh> scaled_;
};

}  // namespace sdf_ccd
