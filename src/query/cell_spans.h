#pragma once

#include <array>

#include "grid_walk.h"
#include "sdf_ccd/query/interval.h"

namespace sdf_ccd {

/// A cell that a walk is in.
struct WalkedCell {
  Vector3i low;   ///< first corner, in cells of the walk
  int side;       ///< in cells of the walk
  double t_exit;  ///< where the walk leaves it
};

/// Takes a walk to t, or at least out of the block that it leaves at t_exit (GridWalk::exit() was asked for), all on
/// one side: appends the span if that is the inside.
void passOneSided(double t, double t_exit, bool inside, GridWalk& walk, Intervals& intervals);

/// Appends the spans of the walk's parameter in which the trilinear function of eight corner values is at most sigma.
void appendCellSpans(const std::array<double, 8>& corners, const GridWalk& walk, const WalkedCell& cell, double sigma,
                     Intervals& intervals);

}  // namespace sdf_ccd
