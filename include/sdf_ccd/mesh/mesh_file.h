#pragma once

#include <string>

#include "sdf_ccd/mesh/triangle_mesh.h"

namespace sdf_ccd {

/// Reads a mesh: STL (binary also when it begins with `solid`; text), OBJ, OFF, PLY and DAE, by the name's ending.
/// Polygons are triangulated, lines and points ignored; vertices equal up to 2^-24 of the longest side are welded. DAE
/// is read by assimp, which has the digits of a float; where these would move a vertex by more than 0.1 mm, because the
/// mesh is far from its origin, it is refused.
///
/// Each mesh is read in a process of its own, so that a file that makes the reader crash, hang or exhaust memory only
/// causes an error here. The process has no access to files or the network, at most 512 MiB of memory plus 32 times the
/// file's size (never more than three quarters of the computer's), 5 s of processor time plus 1 s per MiB, and six
/// times that of wall-clock time. It adds some 4 ms to the reading, that of DAE 20 ms. The programs, sdf_ccd_read and
/// sdf_ccd_read_with_libraries, are searched in lib/sdf_ccd beside the library, or at the path in the environment
/// variable SDF_CCD_READER; without them no mesh can be read.
///
/// A DAE mesh is placed as rviz draws it: `<unit meter="…">` is applied, the file's up-axis is not. The material
/// library of an OBJ file is not opened. Not supported: COLLADA's `<convex_mesh>`, `<trifans>`, `<skew>`, polygons with
/// holes, turns about an axis that has not length 1, and `.zae`; binary OFF.
/// @param bytes  the whole file's content.
/// @param name   the file's name; its ending chooses the format, and it appears in errors.
/// @return triangles [m], in the file's frame; every triangle with finite corners.
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, no triangle, not finite, "the
/// reader crashed (SIGSEGV)", "the reader was stopped: it needed more than 512 MiB"; Cancelled, if a CancelScope
/// requests it.
TriangleMesh parseMesh(const std::string& bytes, const std::string& name);

/// The same from a file on disk, of up to 1 GiB: no device, pipe or socket.
TriangleMesh loadMesh(const std::string& path);

/// Boundary of the occupied space of an OctoMap (`.bt` or `.ot`, also the headerless `.bt` of 2010): two triangles for
/// each face between an occupied voxel of the finest size and one that is not occupied. Unknown space counts as free.
///
/// Vertices lie exactly on the voxel grid (a whole number times the resolution) and are shared. The surface is closed,
/// but not a manifold: where two voxels touch only at an edge, four faces meet there, and where they touch at a corner
/// a vertex belongs to both. Distances and signs are not affected; code that needs a manifold must treat such meshes
/// separately (GeometryDescription::watertight_voxels).
/// @param bytes  the whole file's content.
/// @param name   the file's name, which appears in errors.
/// @param resolution  set to the voxels' size [m].
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, damaged, nothing occupied, a tree
/// of another type than OcTree and ColorOcTree, a build without OctoMap, more faces than accepted for the file's size
/// (2 million plus 8,000 per byte, at most 25 million: 19 bytes can encode 10 billion); Cancelled. The file is read by
/// a process of its own, like meshes (parseMesh()), with 512 MiB of memory plus 2,000 times the file's size, at most 6
/// GiB.
TriangleMesh parseOctomapSurface(const std::string& bytes, const std::string& name, double& resolution);

/// The same from a file on disk, of up to 1 GiB: no device, pipe or socket.
TriangleMesh loadOctomapSurface(const std::string& path, double& resolution);

}  // namespace sdf_ccd
