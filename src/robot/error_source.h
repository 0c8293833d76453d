#pragma once

#include <stdexcept>
#include <string>

namespace sdf_ccd {

/// An error again, with where the text is from that it is about; as it is if that is not known.
[[noreturn]] inline void throwFrom(const std::string& source, const std::exception& error) {
  throw std::runtime_error(source.empty() ? error.what() : source + ": " + error.what());
}

}  // namespace sdf_ccd
