#pragma once

#include <functional>

namespace sdf_ccd {

/// Called from one thread at a time with the share done, from 0 to 1.
using Progress = std::function<void(double)>;

}  // namespace sdf_ccd
