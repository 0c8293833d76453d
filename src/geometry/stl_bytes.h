#pragma once

#include <string>

namespace sdf_ccd {

/// A binary STL as assimp reads it safely: its length exactly that of its triangles, its header not `solid`.
/// ASCII files come back as they are.
/// @throws std::runtime_error if the file is neither, or shorter than the triangles it announces.
std::string mendedStl(const std::string& bytes);

}  // namespace sdf_ccd
