#pragma once

#include <vector>

#include "mesh_edges.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Triangles that are oriented together.
struct Patch {
  std::vector<std::int32_t> triangles;
  bool closed = false;  ///< along each of its edges as many triangles run forward as backward
  bool mixed = false;   ///< its triangles are drawn in different orientations, or some in both
};

/// Flips triangles until neighbours over two-triangle edges agree wherever that is possible; of each connected set the
/// larger part, by area, keeps its orientation.
/// @return disjoint patches that cover the mesh: sets that are closed by themselves; of the rest, sets that are
/// connected over edges of any number of triangles and together closed; and every other set by itself.
std::vector<Patch> orientConsistently(TriangleMesh& mesh);

/// The patch's triangles alone.
TriangleMesh extract(const TriangleMesh& mesh, const Patch& patch);

void flip(TriangleMesh& mesh, const Patch& patch);

/// The mesh moved and scaled so that it is about 1 m large and near the origin: then tolerances do not depend on its
/// units, and no digits are lost to its distance from the origin.
TriangleMesh normalized(TriangleMesh mesh);

}  // namespace sdf_ccd
