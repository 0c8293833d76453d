#include "mesh_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace sdf_ccd {

std::vector<EdgeUse> edgeUses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3i& t = mesh.triangles[i];
    for (int corner = 0; corner < 3; ++corner) {
      const int from = t[corner], to = t[(corner + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(i), from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return uses;
}

bool isClosed(const TriangleMesh& mesh) {
  bool closed = true;
  forEachEdge(edgeUses(mesh),
              [&](const EdgeUse* first, const EdgeUse* last) { closed = closed && imbalance(first, last) == 0; });
  return closed;
}

TriangleSets::TriangleSets(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

std::int32_t TriangleSets::find(std::int32_t triangle) {
  while (parent_[triangle] != triangle) triangle = parent_[triangle] = parent_[parent_[triangle]];
  return triangle;
}

void TriangleSets::join(std::int32_t first, std::int32_t second) {
  first = find(first);
  second = find(second);
  parent_[std::max(first, second)] = std::min(first, second);
}

}  // namespace sdf_ccd
