#pragma once

#include <string>

#include "sdf_ccd/field.h"
#include "shell/point_shell.h"

namespace sdf_ccd::tools {

/// "x y z .. x y z m"
std::string describe(const AlignedBox3d& box);

/// Cells, memory, error and band of a sampled field, in one line.
std::string describe(const DistanceField& field);

/// Points and covering radius of a shell, in one line.
std::string describe(const PointShell& shell);

/// "none", or the area and reach of the caps that close the mesh, and what follows for inside and outside.
std::string describeOpenings(const DistanceField& field);

}  // namespace sdf_ccd::tools
