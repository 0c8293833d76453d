#pragma once

#include <visualization_msgs/MarkerArray.h>

#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Markers of the world's objects as they are checked; of a voxel map, the occupied voxels that have a free neighbour,
/// darker the lower they are.
visualization_msgs::MarkerArray toWorldMarkers(const SceneDescription& scene);

/// Centres of the voxels at the surface of a map (see loadOctomapSurface()), each once.
/// @param size  receives the voxels' size [m].
std::vector<Vector3d> surfaceVoxels(const TriangleMesh& surface, double& size);

}  // namespace sdf_ccd
