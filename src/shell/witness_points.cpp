#include "shell/witness_points.h"

#include <algorithm>

#include "../geometry/mesh_edges.h"
#include "common/infinity.h"

namespace sdf_ccd {

SampledPoints witnessPoints(const TriangleMesh& mesh) {
  validate(mesh);
  const std::vector<std::int32_t> component = componentOfVertices(mesh);
  SampledPoints witnesses;
  witnesses.covering_radius = kInfinity;
  std::vector<char> seen(mesh.triangles.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    char& component_seen = seen[component[mesh.triangles[i][0]]];
    if (component_seen != 0) continue;
    component_seen = 1;
    witnesses.points.push_back(mesh.vertices[mesh.triangles[i][0]]);
    const Vector3d normal = areaNormal(mesh, static_cast<int>(i));
    const Vector3d unit = normal.squaredNorm() > 0.0 ? Vector3d(normal.normalized()) : Vector3d::UnitZ();
    witnesses.normals.push_back(unit.cast<float>());
    witnesses.areas.push_back(0.0F);
  }
  return witnesses;
}

}  // namespace sdf_ccd
