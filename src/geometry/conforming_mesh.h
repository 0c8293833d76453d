#pragma once

#include "mesh_edges.h"

namespace sdf_ccd {

/// A mesh whose neighbours share whole edges.
struct ConformingMesh {
  TriangleMesh mesh;                 ///< with the vertices of the other
  std::vector<std::int32_t> source;  ///< of each triangle: the one of the other mesh that it is a part of
};

/// Lets triangles share vertices that lie at one place, and splits them at vertices that lie on their sides, as far as
/// digits of doubles or else of floats tell, where such a side is not run through as often either way: faces that were
/// tessellated apart meet so, of one part or of two.
/// Triangles without height, which fill such seams in some files, have no part there. The mesh as it is where that
/// leaves sides of an odd number of triangles: in open meshes, what is joined in part says little. For questions of
/// what is connected with what; the parts of a triangle are flat only up to that tolerance.
/// @param mesh  welded.
ConformingMesh conformingMesh(const TriangleMesh& mesh);

}  // namespace sdf_ccd
