#pragma once

#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// Least radius with which balls about the shell's points cover the mesh: exact, to a rounding upwards of 1e-9.
/// @param scale  approximate distance between points [m]: larger triangles are halved before points are searched.
double coveringRadius(const TriangleMesh& mesh, const PointShell& shell, double scale);

/// Area of the mesh nearest to each point, among points whose normal is not against the triangle's, so that the two
/// sides of a thin plate do not share. Exact; the sum is the mesh's area.
std::vector<double> nearestAreas(const TriangleMesh& mesh, const PointShell& shell, double scale);

}  // namespace sdf_ccd
