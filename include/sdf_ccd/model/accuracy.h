#pragma once

#include <string>

namespace sdf_ccd {

/// What is wanted of bodies that are prepared to be checked.
struct Accuracy {
  double max_error = 1e-3;           ///< of a verdict about two of them, but for what motions add [m]
  std::string cache_directory = {};  ///< where what was made is kept, and found again; empty: nowhere
};

}  // namespace sdf_ccd
