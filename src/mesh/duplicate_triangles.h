#pragma once

#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// The triangles of a welded mesh, each once except for faces that parts share.
struct DistinctTriangles {
  TriangleMesh mesh;            ///< without `walls`
  std::vector<Vector3i> walls;  ///< corners in `mesh`, one triangle of each pair
  std::vector<char> both_ways;  ///< per triangle of `mesh`, whether a copy of it faced the other way; empty: none did
  int copies = 0;               ///< triangles left out because another has the same corners, in either orientation
  double copied_area = 0.0;     ///< of those [m²]
};

/// Of triangles with the same corners one is kept: a face that is drawn from both sides, or twice, is one face.
///
/// Walls are the exception: patches of such faces with at least two other triangles at every border edge. Such a patch
/// may be the wall between two parts of a solid, whose surface the other triangles form, or a sheet across an opening;
/// with one of its sides kept, the rest would be open. Which of the two it is can be decided when the rest is oriented
/// (see hiddenWalls()). If all copies have the same orientation, the patch is a face that two parts share, one of which
/// lies in the other: then all copies are kept, as each closes one part.
DistinctTriangles distinctTriangles(const TriangleMesh& mesh);

}  // namespace sdf_ccd
