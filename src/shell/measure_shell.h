#pragma once

#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// The parts of a mesh that are nearest to each point of its shell. For each triangle only points compete whose normal
/// does not oppose the triangle's, so that the points on the two sides of a thin plate get the area of their own side;
/// all points, if all oppose it.
struct ShellMeasures {
  std::vector<double> areas;     ///< per point, of its parts [m²]; exact, the sum is the mesh's area
  double covering_radius = 0.0;  ///< largest distance of a part from its point [m], rounded up by a relative 1e-9
};

/// @param shell  one or more points.
/// @param scale  approximate distance between points [m]: larger triangles are halved before the search for points.
ShellMeasures measureShell(const TriangleMesh& mesh, const PointShell& shell, double scale);

}  // namespace sdf_ccd
