#pragma once

#include <array>

#include "common/compiler_lanes.h"
#include "sdf_ccd/segments.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A trilinear cell along a straight line, minus the isovalue: c0 + c1 u + c2 u² + c3 u³ (design §3.1).
struct CellCubic {
  std::array<double, 4> c;

  double operator()(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
  double slope(double u) const { return c[1] + u * (2.0 * c[2] + u * 3.0 * c[3]); }
};

/// The coefficients for a line from a point in the cell's [0, 1]³ along d. @tparam Number  double, or lanes of them.
template <class Number>
SDF_CCD_INLINE std::array<Number, 4> cubicAlong(const std::array<Number, 8>& k, const std::array<Number, 3>& from,
                                                const std::array<Number, 3>& d) {
  // Substitute the line into A(x, y) + z B(x, y), each bilinear.
  const Number xy0 = from[0] * from[1], xy1 = from[0] * d[1] + from[1] * d[0], xy2 = d[0] * d[1];
  const Number ax = k[1] - k[0], ay = k[2] - k[0], axy = (k[3] - k[2]) - ax;
  const Number a0 = k[0] + ax * from[0] + ay * from[1] + axy * xy0;
  const Number a1 = ax * d[0] + ay * d[1] + axy * xy1, a2 = axy * xy2;
  const Number bz = k[4] - k[0], bx = (k[5] - k[4]) - ax, by = (k[6] - k[4]) - ay;
  const Number bxy = ((k[7] - k[6]) - (k[5] - k[4])) - axy;
  const Number b0 = bz + bx * from[0] + by * from[1] + bxy * xy0;
  const Number b1 = bx * d[0] + by * d[1] + bxy * xy1, b2 = bxy * xy2;
  return {a0 + from[2] * b0, a1 + from[2] * b1 + d[2] * b0, a2 + from[2] * b2 + d[2] * b1, d[2] * b2};
}

/// The cubic of u in [0, 1] from the local point `from` to `to`, both in the cell's [0, 1]³.
CellCubic cellCubic(const std::array<double, 8>& corners, const Vector3d& from, const Vector3d& to, double sigma);

/// Where a cubic is not positive within [0, 1].
struct CellIntervals {
  std::array<Interval, 3> interval;
  int count = 0;
};

/// All intervals: the extrema separate the roots, and each root is bracketed. A minimum that touches zero to rounding
/// counts as an interval of no length.
CellIntervals nonPositive(const CellCubic& cubic);

/// The minimum of a cubic within [0, 1].
struct CubicMinimum {
  double u;
  double value;
};
CubicMinimum minimumOf(const CellCubic& cubic);

}  // namespace sdf_ccd
