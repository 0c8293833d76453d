#pragma once

#include <vector>

#include "mesh_edges.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Triangles whose orientation is one decision.
struct Patch {
  std::vector<std::int32_t> triangles;
  bool closed = false;  ///< along each of its edges as many triangles run forward as backward
  bool mixed = false;   ///< parts of it are drawn one way round, others the other way, or both ways
};

/// Turns triangles until neighbours over two-triangle edges agree wherever that is possible; of each connected
/// set the larger part, by area, stays as it is.
/// @return disjoint patches that cover the mesh: sets that are closed by themselves; of the rest, what is connected
/// over edges of any number of triangles and closed together; and every other set by itself.
std::vector<Patch> orientConsistently(TriangleMesh& mesh);

/// The patch's triangles alone.
TriangleMesh extract(const TriangleMesh& mesh, const Patch& patch);

void flip(TriangleMesh& mesh, const Patch& patch);

/// The mesh moved and scaled so that it is about 1 m large and near the origin: there, tolerances hold whatever its
/// units, and no digits are lost to its distance.
TriangleMesh normalized(TriangleMesh mesh);

}  // namespace sdf_ccd
