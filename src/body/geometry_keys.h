#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// What stands for a body's geometry: equal for equal content, wherever the body is. Meshes are read once, as long as
/// somebody holds them.
class GeometryKeys {
 public:
  std::string keyOf(const BodyDescription& body);

 private:
  struct Known {
    std::weak_ptr<const TriangleMesh> mesh;
    std::string hash;
  };
  const std::string& hashOf(const std::shared_ptr<const TriangleMesh>& mesh);

  std::unordered_map<const TriangleMesh*, Known> hashes_;
};

/// Has bodies hold those meshes of equal content that others of this process hold, who have called it too.
void shareMeshes(std::vector<BodyDescription>& bodies);

}  // namespace sdf_ccd
