#pragma once

#include "oracle/sampled_function.h"

namespace sdf_ccd::test {

/// A brick of smooth but curved values, so that every cell is a different trilinear function.
inline DistanceField curvedField() {
  const auto value = [](const Vector3d& p) {
    const double wave = 0.05 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y()) + 0.02 * std::sin(11.0 * p.z());
    return 0.75 * (0.9 * p.z() - 0.1 + wave);
  };
  return sampledFunction(value, Vector3i::Ones(), 0.1, 0.2);
}

}  // namespace sdf_ccd::test
