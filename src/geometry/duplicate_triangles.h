#pragma once

#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// The triangles of a welded mesh, each once but for faces that parts share.
struct DistinctTriangles {
  TriangleMesh mesh;            ///< without `walls`
  std::vector<Vector3i> walls;  ///< corners in `mesh`, one triangle of each pair
  std::vector<char> both_ways;  ///< per triangle of `mesh`, whether copies of it faced the other way; empty if of none
  int copies = 0;               ///< triangles left out because the same corners are there already, either way round
  double copied_area = 0.0;     ///< of those [m²]
};

/// Of triangles with the same corners one is kept: a face that is drawn from both sides, or twice, is one face.
///
/// Walls are the exception: patches of such faces whose every border edge carries at least two other triangles. Without
/// them the rest may be the skin of a solid and the wall between two of its parts, or a sheet across an opening; with
/// one of their sides the rest would be open. What they are is decided when the rest is oriented (see hiddenWalls()).
/// Where all copies are drawn the same way round, such a patch is a face that parts share, one of which lies in the
/// other: then all copies stay, each of them closes a part.
DistinctTriangles distinctTriangles(const TriangleMesh& mesh);

}  // namespace sdf_ccd
