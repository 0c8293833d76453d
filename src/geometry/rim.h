#pragma once

#include <map>
#include <utility>
#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// What is left to close of a mesh, as directed edges with multiplicities (a 1-chain without boundary: into each vertex
/// run as many as out of it), and the triangles that were added so far. Each of them takes its own boundary off the
/// rest, so mesh, triangles and rest fit together at any time, and an empty rest says that the mesh is closed.
class Rim {
 public:
  /// @param mesh  welded; outlives this.
  explicit Rim(const TriangleMesh& mesh);

  bool empty() const { return edges_.empty(); }

  /// Bridges cracks: makes one of vertices within `tolerance` [m] of each other, and lets edges run through vertices
  /// within half of it.
  void join(double tolerance);

  /// Takes the rest apart into simple loops of vertices, which are no longer part of it: they must be capped.
  std::vector<std::vector<int>> takeLoops();

  /// Adds a triangle, n times; turned round if n is negative.
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
