#pragma once

#include <stdexcept>
#include <string>

namespace sdf_ccd {

/// @throws std::invalid_argument always.
[[noreturn]] inline void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

}  // namespace sdf_ccd
