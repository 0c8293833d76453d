#include "edge_search.h"

#include <algorithm>

#include "common/cancel_point.h"

namespace sdf_ccd {

EdgeSearch::EdgeSearch(const TriangleMesh& mesh, const std::vector<std::pair<int, int>>& edges) {
  TriangleMesh segments;
  segments.vertices.reserve(2 * edges.size());
  segments.triangles.reserve(edges.size());
  std::vector<char> is_end(mesh.vertices.size(), 0);
  CancelTicks<4096> cancel;
  for (const auto& [from, to] : edges) {
    cancel.check();
    const int first = static_cast<int>(segments.vertices.size());
    segments.vertices.push_back(mesh.vertices[from]);
    segments.vertices.push_back(mesh.vertices[to]);
    segments.triangles.emplace_back(first, first + 1, first + 1);
    is_end[from] = is_end[to] = 1;
  }
  for (std::size_t v = 0; v < is_end.size(); ++v)
    if (is_end[v]) vertices_.push_back(static_cast<int>(v));
  constexpr double kSmallestMesh = 1e-8;  // [m]; a tree refuses smaller ones
  if (boundingBox(segments).sizes().maxCoeff() > kSmallestMesh) tree_.emplace(segments);
}

void EdgeSearch::find(const Vector3d& p, double distance, std::vector<int>& found) const {
  found.clear();
  if (tree_) tree_->trianglesWithin(p, distance, found);
}

void sortAlong(const TriangleMesh& mesh, const std::pair<int, int>& edge, std::vector<int>& vertices) {
  const Vector3d &a = mesh.vertices[edge.first], along = mesh.vertices[edge.second] - a;
  const auto share = [&](int vertex) { return along.dot(mesh.vertices[vertex] - a); };
  std::sort(vertices.begin(), vertices.end(),
            [&](int p, int q) { return std::pair(share(p), p) < std::pair(share(q), q); });
}

}  // namespace sdf_ccd
