#pragma once

#include <cstdint>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A ball free of surface: what a coarse cell says in whose neighbourhood there is none.
///
/// A query skips to where a segment leaves the ball (design §3.3). The ball about the cell's own centre ends at the
/// surface; one about a point farther out touches the surface there too, holds the first, and is left later by all
/// segments that do not run straight at the surface. So the centre is the point, of a lattice as wide as the cells, out
/// to which the distance grows as fast as a distance can.
struct EmptySphere {
  static constexpr int kMostOffset = 15;
  static constexpr int kMostSteps = (1 << 14) - 1;
  /// The cell's own place may be nearer to the surface than the ball says by this many cells, where it is not the
  /// ball's centre.
  static constexpr double kSlack = 0.15;

  Vector3i offset = Vector3i::Zero();  ///< of the centre from the cell's own place of the lattice [cells]
  int steps = 0;                       ///< radius, rounded down, in steps of step()
  bool inside = false;                 ///< of the body, with all of the cell

  /// For a grid of this many cells, in which no distance exceeds the diagonal [cells].
  static double step(const Vector3i& size) { return size.cast<double>().norm() / kMostSteps; }

  /// In the bits above the last two, which are zero.
  std::uint32_t word() const;
  static EmptySphere of(std::uint32_t word);
};

}  // namespace sdf_ccd
