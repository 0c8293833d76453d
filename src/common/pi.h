#pragma once

namespace sdf_ccd {

constexpr double kPi = 3.14159265358979323846;

}  // namespace sdf_ccd
