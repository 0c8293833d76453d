#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads COLLADA 1.4 and 1.5: the meshes of the scene's nodes and of the nodes they instance, skins in the shape that
/// they are drawn in. As rviz draws it: the unit is applied, the up-axis is not.
///
/// Of `<mesh>` are read triangles, polylist, polygons (without holes), trifans and tristrips; lines are passed over.
/// @throws std::runtime_error with the reason: what is not well-formed or refers to what is not there, nodes that
/// contain themselves, and more than 20,000 nodes once instances are followed.
TriangleMesh parseDae(const std::string& bytes);

}  // namespace sdf_ccd
