#pragma once

#include <vector>

#include "sampled_points.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

struct ShellMeasures {
  /// Per point, the area of the mesh whose nearest point it is [m²]. Only points whose normal does not oppose a
  /// triangle's compete for it, so that the points on the two sides of a thin plate get the area of their own side; all
  /// points, if all oppose it. Exact; the sum is the mesh's area.
  std::vector<double> areas;
  /// The smallest radius with which spheres about the points cover the mesh [m], rounded up by a relative 1e-9.
  double covering_radius = 0.0;
};

/// @param shell  one or more points.
/// @param scale  approximate distance between points [m]: larger triangles are halved before the search for points.
ShellMeasures measureShell(const TriangleMesh& mesh, const SampledPoints& shell, double scale);

}  // namespace sdf_ccd
