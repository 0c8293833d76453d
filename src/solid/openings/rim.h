#pragma once

#include <map>
#include <utility>
#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// The part of a mesh that is still open, as directed edges with multiplicities (a 1-chain without boundary: as many
/// edges enter a vertex as leave it), and the triangles that were added so far. Adding a triangle subtracts its
/// boundary from the open edges, so that these always fit mesh and triangles; when none are left, the mesh is closed.
class Rim {
 public:
  /// @param mesh  welded; outlives this.
  explicit Rim(const TriangleMesh& mesh);

  bool empty() const { return edges_.empty(); }

  /// Bridges cracks: merges vertices within `tolerance` [m] of each other, and makes edges pass through vertices within
  /// half of it.
  void join(double tolerance);

  /// Returns the open edges as simple loops of vertices and removes them; the caller must cap the loops.
  std::vector<std::vector<int>> takeLoops();

  /// Adds a triangle, n times; flipped if n is negative.
  void fill(int a, int b, int c, int n = 1);

  const std::vector<Vector3i>& triangles() const { return triangles_; }

 private:
  using Edge = std::pair<int, int>;  // ascending

  void add(int from, int to, int n);
  std::vector<std::pair<Edge, int>> edges() const { return {edges_.begin(), edges_.end()}; }
  void mergeVertices(double tolerance);
  void splitEdges(double tolerance);

  const TriangleMesh& mesh_;
  std::map<Edge, int> edges_;  // how often from the lower vertex to the higher one; never 0
  std::vector<Vector3i> triangles_;
};

}  // namespace sdf_ccd
