#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Boundary of the occupied space of an OctoMap (`.bt` or `.ot`, also the headerless `.bt` of 2010): two triangles
/// for each face between an occupied voxel of the finest size and one that is not. Unknown space counts as free.
///
/// Vertices lie exactly on the voxel grid (a whole number times the resolution) and are shared. The surface is closed,
/// but not a manifold: where two voxels touch only at an edge, four faces meet there, and where they touch at a corner
/// a vertex belongs to both. Distances and signs do not mind; what wants a manifold should be told that these are whole
/// voxels (GeometryDescription::watertight_voxels).
/// @param resolution  set to the voxels' size [m].
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, damaged, nothing occupied, a tree
/// of another type than OcTree and ColorOcTree, a build without OctoMap, more faces than are taken of a file of its
/// size (2 million and 8,000 per byte, at most 25 million: 19 bytes can mean 10 billion); Cancelled. The file is read
/// by a process of its own, as those of meshes (parseMesh()), with 512 MiB of memory and 2,000 times the file's size,
/// at most 6 GiB.
TriangleMesh loadOctomapSurface(const std::string& path, double& resolution);

}  // namespace sdf_ccd
