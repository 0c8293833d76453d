#pragma once

#include <array>

#include "common/compiler_lanes.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

// Interpolation between the eight values at a cell's corners: bit 0 of a corner's index is x, bit 1 y, bit 2 z.

/// The value at (u, v, w) in [0, 1]³.
inline double trilinear(const std::array<double, 8>& c, const Vector3d& u) {
  const double x0 = c[0] + u.x() * (c[1] - c[0]), x1 = c[2] + u.x() * (c[3] - c[2]);
  const double x2 = c[4] + u.x() * (c[5] - c[4]), x3 = c[6] + u.x() * (c[7] - c[6]);
  const double y0 = x0 + u.y() * (x1 - x0), y1 = x2 + u.y() * (x3 - x2);
  return y0 + u.z() * (y1 - y0);
}

/// The gradient per unit of (x, y, z). @tparam Number  double, or lanes of them.
template <class Number>
SDF_CCD_INLINE std::array<Number, 3> trilinearGradient(const std::array<Number, 8>& c, const Number& x, const Number& y,
                                                       const Number& z) {
  const auto mix = [](const Number& a, const Number& b, const Number& s) __attribute__((always_inline)) {
    return a + s * (b - a);
  };
  return {mix(mix(c[1] - c[0], c[3] - c[2], y), mix(c[5] - c[4], c[7] - c[6], y), z),
          mix(mix(c[2] - c[0], c[3] - c[1], x), mix(c[6] - c[4], c[7] - c[5], x), z),
          mix(mix(c[4] - c[0], c[5] - c[1], x), mix(c[6] - c[2], c[7] - c[3], x), y)};
}

inline Vector3d trilinearGradient(const std::array<double, 8>& corners, const Vector3d& u) {
  const std::array<double, 3> gradient = trilinearGradient(corners, u.x(), u.y(), u.z());
  return {gradient[0], gradient[1], gradient[2]};
}

}  // namespace sdf_ccd
