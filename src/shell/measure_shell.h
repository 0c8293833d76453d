#pragma once

#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// Least radius with which balls about the shell's points cover the mesh: an upper bound, at most 1 % above it
/// (or above the rounding of the mesh's size, where the points hit the whole mesh).
double coveringRadius(const TriangleMesh& mesh, const PointShell& shell);

/// Area of the mesh nearest to each point, among points whose normal is not against the triangle's, so that the two
/// sides of a thin plate do not share. Cell borders are resolved to `resolution` [m]. The sum is the mesh's area.
std::vector<double> nearestAreas(const TriangleMesh& mesh, const PointShell& shell, double resolution);

}  // namespace sdf_ccd
