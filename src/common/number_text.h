#pragma once

#include <string>

#include <fmt/format.h>

namespace sdf_ccd {

/// A number as messages show it: six digits, also of 1e300, of which std::to_string() would print 308.
inline std::string numberText(double value) {
  return fmt::format("{:g}", value);
}

}  // namespace sdf_ccd
