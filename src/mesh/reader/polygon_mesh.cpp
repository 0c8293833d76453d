#include "polygon_mesh.h"

#include <stdexcept>
#include <string>

#include "mesh/polygon.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxCorners = 10'000;  // ear clipping takes time of their square, at worst of their cube

}  // namespace

void appendPolygon(const std::vector<std::int64_t>& corners, TriangleMesh& mesh) {
  if (corners.size() > kMaxCorners) {
    throw std::runtime_error("a polygon of " + std::to_string(corners.size()) + " corners; at most " +
                             std::to_string(kMaxCorners) + " are read");
  }
  std::vector<Vector3d> positions;
  for (const std::int64_t corner : corners) {
    if (corner < 0 || corner >= static_cast<std::int64_t>(mesh.vertices.size())) {
      throw std::runtime_error("a face refers to a vertex that does not exist: the file has " +
                               std::to_string(mesh.vertices.size()));
    }
    positions.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
  }
  for (const Vector3i& t : triangulatePolygon(positions)) {
    mesh.triangles.emplace_back(static_cast<int>(corners[t[0]]), static_cast<int>(corners[t[1]]),
                                static_cast<int>(corners[t[2]]));
  }
}

}  // namespace sdf_ccd
