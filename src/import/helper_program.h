#pragma once

#include <string>

namespace sdf_ccd {

/// Where a program is that this library starts: what the environment variable says, else in the folder `sdf_ccd`
/// beside the library (lib/sdf_ccd in devel and install spaces alike), else in the library's own folder.
/// @throws std::runtime_error that names both if it is at neither place.
std::string helperProgram(const std::string& name, const char* environment_variable);

}  // namespace sdf_ccd
