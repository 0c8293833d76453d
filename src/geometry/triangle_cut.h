#pragma once

#include <array>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

using Corners = std::array<Vector3d, 3>;

Corners cornersOf(const TriangleMesh& mesh, int triangle);

double longestEdge(const Corners& c);

/// What cut() takes for nothing: 1e-12 of the mesh's size [m].
double cutTolerance(const TriangleMesh& mesh);

/// Whether two triangles of a mesh cut, touch or overlap each other elsewhere than at vertices and edges they share, to
/// a distance `eps` [m], on the cautious side. It does not depend on which way they face.
bool cut(const TriangleMesh& mesh, int first, int second, double eps);

}  // namespace sdf_ccd
