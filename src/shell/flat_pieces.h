#pragma once

#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// An edge of the surface, and the normal of points on it.
struct SurfaceEdge {
  Vector3d from, to;  ///< [m]
  Vector3d normal;    ///< unit: between those of its triangles
};

/// Cuts a surface into pieces, each within `flatness` [m] of a plane onto which it can be projected without folds, and
/// gives the edges of the pieces. Edges of one triangle or more than two, and those of degenerate triangles, are
/// always among them.
/// @param mesh  welded.
std::vector<SurfaceEdge> edgesOfFlatPieces(const TriangleMesh& mesh, double flatness);

/// The normals of all triangles: unit, or zero for a degenerate one.
std::vector<Vector3d> triangleNormals(const TriangleMesh& mesh);

}  // namespace sdf_ccd
