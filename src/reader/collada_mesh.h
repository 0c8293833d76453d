#pragma once

#include <tinyxml2.h>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// The triangles of a COLLADA `<mesh>`, in the file's units.
/// @throws std::runtime_error with the reason.
TriangleMesh colladaMesh(const tinyxml2::XMLElement& mesh);

}  // namespace sdf_ccd
