#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads a mesh through assimp: STL (binary also when it begins with `solid`; ASCII), DAE, OBJ, OFF, PLY and
/// whatever else assimp knows. Lines and points are ignored; vertices at the same place are welded.
///
/// DAE lies where rviz draws it: `<unit meter="…">` is applied, the file's up-axis is not.
/// @param bytes  the whole file's content.
/// @param name   the file's name; its ending chooses the format, and it appears in errors.
/// @return triangles [m], in the file's frame; every triangle with finite corners.
/// @throws std::runtime_error naming the file and the reason: unreadable, truncated, no triangle, not finite.
/// Damaged STL, DAE, PLY and OFF files that assimp does not survive are refused before it sees them, as far as tests
/// with random damage have found such; assimp runs in this process, so read files from strangers elsewhere first.
/// Not read: COLLADA's `<convex_mesh>` and `.zae`. OFF faces that name a missing vertex get the last one (assimp).
TriangleMesh parseMesh(const std::string& bytes, const std::string& name);

/// The same from a file on disk.
TriangleMesh loadMesh(const std::string& path);

}  // namespace sdf_ccd
