#pragma once

#include <cstdlib>

namespace sdf_ccd::test {

/// How often a test repeats an attack: a fifth of `all`, rounded up, or all if the environment has SDF_CCD_LONG_TESTS, as
/// `scripts/trust long` sets.
inline int rounds(int all) {
  return std::getenv("SDF_CCD_LONG_TESTS") != nullptr ? all : (all + 4) / 5;
}

}  // namespace sdf_ccd::test
