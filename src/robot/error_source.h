#pragma once

#include <stdexcept>
#include <string>

namespace sdf_ccd {

/// The same error with the source of the text in its message; unchanged if the source is not known.
[[noreturn]] inline void throwFrom(const std::string& source, const std::exception& error) {
  throw std::runtime_error(source.empty() ? error.what() : source + ": " + error.what());
}

}  // namespace sdf_ccd
