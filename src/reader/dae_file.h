#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads COLLADA 1.4 and 1.5: the meshes of the scene's nodes and of the nodes they instantiate, skins in their bind
/// shape. The result lies where rviz draws it: the unit is applied, the up-axis is not.
///
/// Reads triangles, polylist, polygons (without holes), trifans and tristrips of a `<mesh>`; lines are skipped.
/// @throws std::runtime_error with the reason: XML that is not well-formed, a reference to a missing element, a node
/// that contains itself, more than 20,000 nodes after instances are expanded.
TriangleMesh parseDae(const std::string& bytes);

}  // namespace sdf_ccd
