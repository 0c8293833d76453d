#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Boundary of the occupied space of an OctoMap (`.bt` or `.ot`, also the headerless `.bt` of 2010): two triangles
/// for each face between an occupied voxel and one that is not. Unknown space counts as free.
/// @param resolution  set to the voxels' size [m].
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, nothing occupied.
TriangleMesh loadOctomapSurface(const std::string& path, double& resolution);

}  // namespace sdf_ccd
