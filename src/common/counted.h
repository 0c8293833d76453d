#pragma once

#include <string>

namespace sdf_ccd {

/// "1 pair", "2 pairs". @param noun  in the singular, with a regular plural.
inline std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

}  // namespace sdf_ccd
