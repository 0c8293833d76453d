#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sdf_ccd {

/// What a PLY header announces.
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<bool> is_list;  ///< per property
};

/// assimp fills up with zeros what an ASCII file announces and does not hold, so that is looked for first.
/// @param body  where the header ends.
/// @throws std::runtime_error if there are fewer elements than announced, or the last one is cut.
void requireWholeAsciiPly(const std::string& bytes, std::size_t body, const std::vector<PlyElement>& elements);
void requireWholeOff(const std::string& bytes, std::size_t body, std::uint64_t vertices, std::uint64_t faces);

}  // namespace sdf_ccd
