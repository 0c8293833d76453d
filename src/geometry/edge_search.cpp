#include "edge_search.h"

#include <algorithm>

namespace sdf_ccd {

EdgeSearch::EdgeSearch(const TriangleMesh& mesh, const std::vector<std::pair<int, int>>& edges) {
  TriangleMesh segments;
  for (const auto& [from, to] : edges) {
    const int first = static_cast<int>(segments.vertices.size());
    segments.vertices.push_back(mesh.vertices[from]);
    segments.vertices.push_back(mesh.vertices[to]);
    segments.triangles.emplace_back(first, first + 1, first + 1);
    vertices_.push_back(from);
    vertices_.push_back(to);
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
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
