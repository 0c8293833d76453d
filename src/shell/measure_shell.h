#pragma once

#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// The smallest radius with which spheres about the shell's points cover the mesh [m], rounded up by a relative 1e-9.
/// @param scale  approximate distance between points [m]: larger triangles are halved before the search for points.
double coveringRadius(const TriangleMesh& mesh, const PointShell& shell, double scale);

/// Per point, the area of the mesh whose nearest point it is [m²]. Only points whose normal does not oppose a
/// triangle's compete for it, so that the points on the two sides of a thin plate get the area of their own side.
/// Exact; the sum is the mesh's area.
std::vector<double> nearestAreas(const TriangleMesh& mesh, const PointShell& shell, double scale);

}  // namespace sdf_ccd
