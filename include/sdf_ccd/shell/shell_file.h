#pragma once

#include <string>

#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// Writes a point shell, as saveField() does a field.
/// @throws std::runtime_error naming the path and the reason.
void saveShell(const PointShell& shell, const std::string& path, const std::string& key = {});

/// Reads a shell file, as loadField().
/// @throws std::runtime_error naming the path and what is wrong with the file.
PointShell loadShell(const std::string& path, const std::string& key = {});

}  // namespace sdf_ccd
