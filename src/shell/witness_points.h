#pragma once

#include "sampled_points.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// One point of each component of a surface (triangles connected by shared vertices): a component that
/// touches no other surface is wholly inside or wholly outside of another body, and this point decides which (design
/// §3.15). The points represent no area, and the covering radius is infinite.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
SampledPoints witnessPoints(const TriangleMesh& mesh);

}  // namespace sdf_ccd
