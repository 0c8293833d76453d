#pragma once

#include <string>

/// What assimp's readers need to be spared of: they trust a file's own counts and keywords, and loop or exhaust the
/// memory where those lie.
namespace sdf_ccd {

/// A binary STL with its length exactly that of its triangles and its header not `solid`; an ASCII STL as it is.
/// @throws std::runtime_error if the file is neither, or shorter than the triangles it announces.
std::string mendedStl(const std::string& bytes);

/// @throws std::runtime_error if the header has no end, an unknown line, or announces more than the file can hold; of
/// an ASCII file, also more than it does hold.
void requireSoundPly(const std::string& bytes);

/// @throws std::runtime_error if the header announces more than the file holds.
void requireSoundOff(const std::string& bytes);

}  // namespace sdf_ccd
