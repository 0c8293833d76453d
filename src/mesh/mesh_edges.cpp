#include "mesh_edges.h"

#include <algorithm>
#include <numeric>

#include "common/cancel_point.h"
#include "common/resize_in_steps.h"

namespace sdf_ccd {
namespace {

/// Stable sort by a vertex, in linear time. It can be cancelled; std::sort of a large mesh could not be for half a
/// second.
template <class Vertex>
void sortInto(std::vector<EdgeUse>& sorted, const std::vector<EdgeUse>& uses, std::size_t vertices,
              const Vertex& vertex) {
  CancelTicks<4096> cancel;
  std::vector<std::size_t> position(vertices + 1, 0);
  for (const EdgeUse& use : uses) ++position[vertex(use) + 1];
  std::partial_sum(position.begin(), position.end(), position.begin());
  for (const EdgeUse& use : uses) {
    cancel.check();
    sorted[position[vertex(use)]++] = use;
  }
}

}  // namespace

std::vector<EdgeUse> edgeUses(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  CancelTicks<4096> cancel;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    cancel.check();
    const Vector3i& t = mesh.triangles[i];
    for (int corner = 0; corner < 3; ++corner) {
      const int from = t[corner], to = t[(corner + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(i), from < to});
    }
  }
  const auto vertices = mesh.vertices.size();
  std::vector<EdgeUse> other;
  resizeInSteps(other, uses.size());
  sortInto(other, uses, vertices, [](const EdgeUse& use) { return use.high; });
  sortInto(uses, other, vertices, [](const EdgeUse& use) { return use.low; });
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

std::vector<std::int32_t> componentOfVertices(const TriangleMesh& mesh) {
  TriangleSets sets(mesh.triangles.size());
  std::vector<std::int32_t> component(mesh.vertices.size(), -1);  // at first some triangle of the vertex
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto triangle = static_cast<std::int32_t>(i);
    for (int corner = 0; corner < 3; ++corner) {
      std::int32_t& first = component[mesh.triangles[i][corner]];
      if (first < 0) first = triangle;
      sets.join(first, triangle);
    }
  }
  for (std::int32_t& triangle : component)
    if (triangle >= 0) triangle = sets.find(triangle);
  return component;
}

}  // namespace sdf_ccd
