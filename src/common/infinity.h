#pragma once

#include <limits>

namespace sdf_ccd {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace sdf_ccd
