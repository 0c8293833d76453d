#pragma once

#include <string>

#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// Writes a point shell; see writeCheckedFile() for what the file guarantees.
/// @throws std::runtime_error naming the path and the reason.
void saveShell(const PointShell& shell, const std::string& path);

/// Reads a shell file.
/// @throws std::runtime_error naming the path and what is wrong with the file.
PointShell loadShell(const std::string& path);

}  // namespace sdf_ccd
