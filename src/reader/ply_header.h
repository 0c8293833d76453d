#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sdf_ccd {

struct PlyType {
  enum class Kind { kSigned, kUnsigned, kFloat };
  Kind kind = Kind::kSigned;
  std::size_t bytes = 1;
};

struct PlyProperty {
  std::string name;
  PlyType type;
  bool is_list = false;
  PlyType count_type;  ///< type of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// Header of a PLY file.
struct PlyHeader {
  enum class Format { kAscii, kLittleEndian, kBigEndian };
  Format format = Format::kAscii;
  std::vector<PlyElement> elements;
  std::size_t end = 0;  ///< offset of the body [bytes]
};

/// @throws std::runtime_error if the header has no end, holds an unknown line, or announces more elements than the file
/// has bytes.
PlyHeader parsePlyHeader(const std::string& bytes);

}  // namespace sdf_ccd
