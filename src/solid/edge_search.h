#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Finds the edges near a point.
class EdgeSearch {
 public:
  /// @param edges  between two vertices of the mesh each.
  EdgeSearch(const TriangleMesh& mesh, const std::vector<std::pair<int, int>>& edges);

  /// The vertices of the edges, in ascending order.
  const std::vector<int>& vertices() const { return vertices_; }

  /// Edges within a distance [m] of p, by their index in the list.
  void find(const Vector3d& p, double distance, std::vector<int>& found) const;

 private:
  std::vector<int> vertices_;
  std::optional<TriangleTree> tree_;
};

/// Sorts vertices by their position along an edge, from its first end on.
void sortAlong(const TriangleMesh& mesh, const std::pair<int, int>& edge, std::vector<int>& vertices);

}  // namespace sdf_ccd
