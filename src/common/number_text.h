#pragma once

#include <string>

#include <fmt/format.h>

namespace sdf_ccd {

/// A number for messages, in six digits: also 1e300, of which std::to_string() would print 308.
inline std::string numberText(double value) {
  return fmt::format("{:g}", value);
}

}  // namespace sdf_ccd
