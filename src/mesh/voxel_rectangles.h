#pragma once

#include "mesh/voxel_solid.h"

namespace sdf_ccd {

/// The boundary of voxels as few large rectangles of two triangles each, with their normals pointing out: the same
/// points as the faces of single voxels, but rectangles need not share edges.
TriangleMesh boundaryRectangles(const VoxelSolid& voxels);

}  // namespace sdf_ccd
