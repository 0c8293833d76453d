#pragma once

#include <string>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Reads COLLADA with assimp in the calling process, unprotected: only for the confined program
/// sdf_ccd_read_with_libraries.
///
/// Files that the mesh refers to are not opened. Coordinates have the digits of a float. The mesh lies where rviz draws
/// it: the transform of the scene's root, in which assimp puts the unit and the up-axis, is not applied, but the unit
/// is.
/// @throws std::exception with the reason, also if the mesh is so far from its origin that floats move its vertices by
/// more than 0.1 mm.
TriangleMesh parseDae(const std::string& bytes);

}  // namespace sdf_ccd
