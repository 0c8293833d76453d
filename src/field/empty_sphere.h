#pragma once

#include <cstdint>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A sphere that contains no surface, stored for a coarse cell that is far from the surface.
///
/// A query skips to the point where a segment leaves the sphere (design §3.3). The largest empty sphere about the
/// cell's centre touches the surface. A sphere about a point farther from the surface can touch it at the same point:
/// it contains the first sphere, and all segments that do not run straight at the surface leave it later. So the centre
/// is a point of a lattice with the cells' spacing up to which the distance grows as fast as a distance can.
struct EmptySphere {
  static constexpr int kMaxOffset = 15;
  static constexpr int kMaxSteps = (1 << 14) - 1;
  /// Tolerance of that growth: if the sphere is about another lattice point than the one where the search began, |φ|
  /// at the latter is at most radius − |offset between the two| + this many cells.
  static constexpr double kSlack = 0.15;

  Vector3i offset = Vector3i::Zero();  ///< of the centre from the cell's own lattice point [cells]
  int steps = 0;                       ///< radius, rounded down, in steps of step()
  bool inside = false;                 ///< whether the sphere, and all of the cell, is inside the body

  /// The step for a grid of this many cells, whose diagonal no distance exceeds [cells].
  static double step(const Vector3i& size) { return size.cast<double>().norm() / kMaxSteps; }

  /// The sphere in 32 bits, the lowest two of which are zero.
  std::uint32_t word() const;
  static EmptySphere of(std::uint32_t word);
};

}  // namespace sdf_ccd
