#pragma once

#include <cstdio>
#include <string>

namespace sdf_ccd {

/// A number as messages show it: six digits, also of 1e300, of which std::to_string() would print 308.
inline std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace sdf_ccd
