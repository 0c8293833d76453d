#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads a mesh: STL (binary also when it begins with `solid`; text), OBJ, OFF, PLY and DAE, by the name's ending.
/// Polygons are triangulated, lines and points ignored; vertices at the same position are welded.
///
/// It is read by a program of its own, sdf_ccd_read, a process for each mesh, so that a file that makes a reader crash,
/// hang or swell is an error here and no more. That process has no files, no network, at most 512 MiB of memory and 32
/// times the file's size (never more than three quarters of the computer's), 5 s of computing and 1 s per MiB, and six
/// times that by the clock. It costs some 2 ms beyond the reading. The program lies in lib/sdf_ccd beside the library,
/// or where the environment variable SDF_CCD_READER says; without it no mesh is read.
///
/// DAE lies where rviz draws it: `<unit meter="…">` is applied, the file's up-axis is not. Of OBJ the material library
/// is not opened. Not read: COLLADA's `<convex_mesh>` and `.zae`, binary OFF.
/// @param bytes  the whole file's content.
/// @param name   the file's name; its ending chooses the format, and it appears in errors.
/// @return triangles [m], in the file's frame; every triangle with finite corners.
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, no triangle, not finite, "the
/// reader crashed (SIGSEGV)", "the reader was stopped: it needed more than 512 MB"; Cancelled, if a CancelScope
/// requests it.
TriangleMesh parseMesh(const std::string& bytes, const std::string& name);

/// The same from a file on disk, of up to 1 GiB: no device, pipe or socket.
TriangleMesh loadMesh(const std::string& path);

/// Boundary of the occupied space of an OctoMap (`.bt` or `.ot`, also the headerless `.bt` of 2010): two triangles
/// for each face between an occupied voxel of the finest size and one that is not. Unknown space counts as free.
///
/// Vertices lie exactly on the voxel grid (a whole number times the resolution) and are shared. The surface is closed,
/// but not a manifold: where two voxels touch only at an edge, four faces meet there, and where they touch at a corner
/// a vertex belongs to both. Distances and signs are not affected; code that needs a manifold must know of whole
/// voxels (GeometryDescription::watertight_voxels).
/// @param resolution  set to the voxels' size [m].
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, damaged, nothing occupied, a tree
/// of another type than OcTree and ColorOcTree, a build without OctoMap, more faces than are taken of a file of its
/// size (2 million and 8,000 per byte, at most 25 million: 19 bytes can mean 10 billion); Cancelled. The file is read
/// by a process of its own, as those of meshes (parseMesh()), with 512 MiB of memory and 2,000 times the file's size,
/// at most 6 GiB.
TriangleMesh loadOctomapSurface(const std::string& path, double& resolution);

}  // namespace sdf_ccd
