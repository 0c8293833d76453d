#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// 128 bits that stand for a mesh's content and for numbers that matter beside it, as 32 hexadecimal digits.
std::string contentHash(const TriangleMesh& mesh, const std::vector<double>& numbers);

}  // namespace sdf_ccd
