#pragma once

#include <string>

namespace sdf_ccd::tools {

/// The content of a text file. @throws std::runtime_error that names it, if it cannot be read or is empty.
std::string readText(const std::string& path);

}  // namespace sdf_ccd::tools
