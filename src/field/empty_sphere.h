#pragma once

#include <cstdint>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// An empty sphere (one without surface) for a coarse cell whose neighbourhood has no surface.
///
/// A query skips to where a segment leaves the sphere (design §3.3). The sphere about the cell's own centre ends at the
/// surface; one about a point farther out touches the surface there too, contains the first, and is left later by all
/// segments that do not run straight at the surface. So the centre is the point, of a lattice as wide as the cells, out
/// to which the distance grows as fast as a distance can.
struct EmptySphere {
  static constexpr int kMaxOffset = 15;
  static constexpr int kMaxSteps = (1 << 14) - 1;
  /// The distance at the cell's own lattice point may be less than the sphere implies by up to this many cells, if that
  /// point is not the sphere's centre.
  static constexpr double kSlack = 0.15;

  Vector3i offset = Vector3i::Zero();  ///< of the centre from the cell's own lattice point [cells]
  int steps = 0;                       ///< radius, rounded down, in steps of step()
  bool inside = false;                 ///< whether the sphere, and all of the cell, is inside the body

  /// For a grid of this many cells: no distance exceeds its diagonal [cells].
  static double step(const Vector3i& size) { return size.cast<double>().norm() / kMaxSteps; }

  /// In the bits above the last two, which are zero.
  std::uint32_t word() const;
  static EmptySphere of(std::uint32_t word);
};

}  // namespace sdf_ccd
