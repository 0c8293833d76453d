#pragma once

#include "mesh/mesh_edges.h"

namespace sdf_ccd {

/// A mesh whose neighbours share whole edges.
struct ConformingMesh {
  TriangleMesh mesh;                 ///< with the vertices of the original mesh
  std::vector<std::int32_t> source;  ///< per triangle: the original triangle of which it is a part
  double moved = 0.0;                ///< upper bound of how far points of the surface were moved [m]
};

/// Merges vertices that coincide, and splits triangles at vertices on their sides, where a side is not used equally
/// often in both directions: so faces are joined that were tessellated separately, of one part or of two. The tolerance
/// is the rounding of doubles or, if that does not suffice, of floats.
/// Triangles without height that fill such seams, as in some files, are dropped; others stay. The mesh is returned
/// unchanged if sides with an odd number of triangles would remain: in open meshes, a partial join says little. For
/// questions of connectivity; the parts of a triangle are flat only to that tolerance.
/// @param mesh  welded.
ConformingMesh conformingMesh(const TriangleMesh& mesh);

}  // namespace sdf_ccd
