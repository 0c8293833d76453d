#pragma once

#include "mesh/corners.h"

namespace sdf_ccd {

/// A triangle of a mesh, with its normal of length one (or zero).
struct FacedTriangle {
  Vector3i vertices;
  Corners corners;
  Vector3d normal;
};

/// How many vertices two triangles of a mesh have in common.
int sharedVertices(const Vector3i& a, const Vector3i& b);

/// Whether two triangles with at most one common vertex cut, touch or overlap each other elsewhere than at that vertex,
/// within a distance `eps` [m]. Conservative, and independent of their orientation.
bool meet(const FacedTriangle& a, const FacedTriangle& b, double eps);

/// The distance that cut() should ignore: 1e-12 of the mesh's size [m].
double cutTolerance(const TriangleMesh& mesh);

/// Whether two triangles of a mesh cut, touch or overlap each other elsewhere than at shared vertices and edges, within
/// a distance `eps` [m]. Conservative, and independent of their orientation.
bool cut(const TriangleMesh& mesh, int first, int second, double eps);

}  // namespace sdf_ccd
