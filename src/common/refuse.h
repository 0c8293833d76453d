#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "common/number_text.h"

namespace sdf_ccd {

/// @throws std::invalid_argument always.
[[noreturn]] inline void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

/// @param unit  behind the value in the message: " m".
/// @throws std::invalid_argument unless the value is finite and positive: "a box's size must be finite and
/// positive, not 0".
inline void requirePositive(const std::string& what, double value, const char* unit = "") {
  if (std::isfinite(value) && value > 0.0) return;
  refuse(what + " must be finite and positive, not " + numberText(value) + unit);
}

}  // namespace sdf_ccd
