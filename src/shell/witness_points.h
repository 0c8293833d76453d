#pragma once

#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// One point of each component of a surface, components being what is connected over shared vertices: a component that
/// touches no other surface lies wholly inside or wholly outside of another body, and this point tells which (design
/// §3.15). The points stand for no area, and the covering radius is infinite.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
PointShell witnessPoints(const TriangleMesh& mesh);

}  // namespace sdf_ccd
