#pragma once

#include <array>

#include "sdf_ccd/common/eigen_types.h"
#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd {

/// A trilinear cell along a straight line, minus the isovalue: c0 + c1 u + c2 u² + c3 u³ (design §3.1).
struct CellCubic {
  std::array<double, 4> c;

  double operator()(double u) const { return c[0] + u * (c[1] + u * (c[2] + u * c[3])); }
  double slope(double u) const { return c[1] + u * (2.0 * c[2] + u * 3.0 * c[3]); }
};

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
