#pragma once

#include <string>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Asks whether a mesh of more than 50 m is in millimetres: it is then a thousand times as long as it should be, and
/// fields and shells of its size take minutes. Empty for smaller ones.
std::string unitHint(const TriangleMesh& mesh);

}  // namespace sdf_ccd
