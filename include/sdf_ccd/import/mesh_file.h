#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads a mesh: STL (binary also when it begins with `solid`; text), OBJ, OFF, PLY and DAE, by the name's ending.
/// Polygons are triangulated, lines and points ignored; vertices at the same place are welded.
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
/// reader crashed (SIGSEGV)", "the reader was stopped: it needed more than 512 MB"; Cancelled, where a CancelScope asks
/// for it.
TriangleMesh parseMesh(const std::string& bytes, const std::string& name);

/// The same from a file on disk, of up to 1 GiB: no device, pipe or socket.
TriangleMesh loadMesh(const std::string& path);

}  // namespace sdf_ccd
