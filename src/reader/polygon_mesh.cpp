#include "polygon_mesh.h"

#include <stdexcept>
#include <string>

#include "geometry/polygon.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kMaxCorners = 10'000;  // ear clipping takes time of their square, at worst of their cube

void append(const std::int64_t* corners, std::size_t count, TriangleMesh& mesh) {
  std::vector<Vector3d> positions;
  for (std::size_t i = 0; i < count; ++i) {
    if (corners[i] < 0 || corners[i] >= static_cast<std::int64_t>(mesh.vertices.size())) {
      throw std::runtime_error("a face refers to a vertex that does not exist: the file has " +
                               std::to_string(mesh.vertices.size()));
    }
    positions.push_back(mesh.vertices[static_cast<std::size_t>(corners[i])]);
  }
  for (const Vector3i& t : triangulatePolygon(positions)) {
    mesh.triangles.emplace_back(static_cast<int>(corners[t[0]]), static_cast<int>(corners[t[1]]),
                                static_cast<int>(corners[t[2]]));
  }
}

}  // namespace

void PolygonList::add(const std::vector<std::int64_t>& corners) {
  if (corners.size() > kMaxCorners) {
    throw std::runtime_error("a polygon of " + std::to_string(corners.size()) + " corners; at most " +
                             std::to_string(kMaxCorners) + " are read");
  }
  if (corners.size() < 3) return;
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  ends_.push_back(corners_.size());
}

void PolygonList::appendTo(TriangleMesh& mesh) const {
  std::size_t begin = 0;
  for (const std::size_t end : ends_) {
    append(corners_.data() + begin, end - begin, mesh);
    begin = end;
  }
}

}  // namespace sdf_ccd
