#pragma once

#include <string>

namespace sdf_ccd {

/// Path of a helper program of this library: from the environment variable, else in the folder `sdf_ccd`
/// beside the library (lib/sdf_ccd in devel and install spaces alike), else in the library's own folder.
/// @throws std::runtime_error that names both if it is in neither folder.
std::string helperProgram(const std::string& name, const char* environment_variable);

}  // namespace sdf_ccd
