#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// SHA-256 of a mesh's content and of numbers that matter beside it, as 52 digits (base 32, with which it fits into the
/// key of a checked file). Meshes come from requests and files of others, who must not be able to make two that are
/// taken for one another.
std::string contentHash(const TriangleMesh& mesh, const std::vector<double>& numbers);

/// Whether two meshes have the same content, bit for bit.
bool areIdentical(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace sdf_ccd
