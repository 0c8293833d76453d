#include "mended_bytes.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <stdexcept>

namespace sdf_ccd {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50;

bool startsAsText(const std::string& bytes) {
  const auto start =
      std::find_if(bytes.begin(), bytes.end(), [](char c) { return !std::isspace(static_cast<unsigned char>(c)); });
  const std::string word = bytes.substr(static_cast<std::size_t>(start - bytes.begin()), 5);
  return word == "solid" || word == "SOLID" || word == "Solid";
}

/// Text holds no zero byte; the attribute bytes, the count and most coordinates of a binary file do.
bool isText(const std::string& bytes) {
  const std::string head = bytes.substr(0, 4096);
  return startsAsText(head) && head.find('\0') == std::string::npos &&
         (bytes.find("facet") != std::string::npos || bytes.find("FACET") != std::string::npos);
}

std::uint64_t announcedTriangles(const std::string& bytes) {
  std::uint64_t count = 0;
  for (int i = 3; i >= 0; --i) count = count << 8 | static_cast<unsigned char>(bytes[80 + i]);
  return count;
}

}  // namespace

std::string mendedStl(const std::string& bytes) {
  const bool fits = bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * announcedTriangles(bytes);
  if (!fits && isText(bytes)) return bytes;
  if (bytes.size() < kHeader) {
    throw std::runtime_error("truncated: " + std::to_string(bytes.size()) + " bytes are neither ASCII nor binary STL");
  }
  const std::uint64_t length = kHeader + kTriangle * announcedTriangles(bytes);
  if (bytes.size() < length) {
    throw std::runtime_error("truncated: " + std::to_string(announcedTriangles(bytes)) + " triangles need " +
                             std::to_string(length) + " bytes, there are " + std::to_string(bytes.size()));
  }
  std::string result = bytes.substr(0, length);
  std::fill_n(result.begin(), 80, ' ');
  return result;
}

}  // namespace sdf_ccd
