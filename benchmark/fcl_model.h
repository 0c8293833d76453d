#pragma once

#include <memory>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd::benchmark {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

/// A mesh as an FCL bounding volume hierarchy, in double precision.
inline std::unique_ptr<FclModel> fclModel(const TriangleMesh& mesh) {
  std::vector<fcl::Triangle> triangles;
  for (const Vector3i& t : mesh.triangles) triangles.emplace_back(t.x(), t.y(), t.z());
  auto model = std::make_unique<FclModel>();
  model->beginModel(int(triangles.size()), int(mesh.vertices.size()));
  model->addSubModel(mesh.vertices, triangles);
  model->endModel();
  return model;
}

}  // namespace sdf_ccd::benchmark
