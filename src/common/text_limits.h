#pragma once

#include <cstddef>
#include <string>

/// Limits of texts from elsewhere, checked before parsing: some parsers recurse for each nested level, read beyond the
/// end of truncated text, or need 500 bytes of memory per byte of YAML.
namespace sdf_ccd {

constexpr std::size_t kMaxXmlBytes = std::size_t{64} << 20, kMaxYamlBytes = std::size_t{1} << 20;

/// @throws std::runtime_error if it is larger than kMaxXmlBytes.
void requireXmlSize(const std::string& xml);

/// The text as valid UTF-8: invalid bytes, and control characters except tabs and line ends, become '?'.
std::string soundText(std::string text);

}  // namespace sdf_ccd
