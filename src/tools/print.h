#pragma once

#include <cstddef>
#include <string>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd::tools {

/// A number with this many decimals.
std::string rounded(double value, int decimals);

/// A number with three significant digits.
std::string shortly(double value);

/// "1.2 MB"
std::string megabytes(std::size_t bytes);

/// "x y z .. x y z m"
std::string describe(const AlignedBox3d& box);

/// Cells, memory, error and band of a sampled field, in one line.
std::string describe(const DistanceField& field);

/// Points and covering radius of a shell, in one line.
std::string describe(const PointShell& shell);

/// "none", or the area and reach of the caps that close the mesh, and what follows for inside and outside.
std::string describeOpenings(const DistanceField& field);

}  // namespace sdf_ccd::tools
