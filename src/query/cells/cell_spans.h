#pragma once

#include <array>

#include "ball_exit.h"
#include "cell_cubic.h"
#include "grid_walk.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// The cell that a walk is in.
struct WalkedCell {
  Vector3i low;   ///< first corner, in cells of the walk
  int side;       ///< in cells of the walk
  double t_exit;  ///< where the walk leaves it
};

/// A sphere in which the field is nowhere sigma, so that all of it is on one side of the isosurface.
struct EmptyBall {
  Vector3d center;  ///< [m]
  double radius;    ///< [m]
  bool inside;
};

/// Advances a walk to t, if all points up to there are on one side; appends the span if that is the inside.
void passTo(double t, bool inside, GridWalk& walk, Intervals& intervals);

/// Advances a walk out of a block of cells [low, low + side) that lies on the same side of the isosurface as an empty
/// sphere, and on to the exit from that sphere.
void passFree(const Vector3i& low, int side, const EmptyBall& ball, const BallExit& ball_exit, GridWalk& walk,
              Intervals& intervals);

/// The trilinear function of a cell's corner values along the walk, from its position to its exit, minus sigma.
CellCubic cubicAlong(const std::array<double, 8>& corners, const GridWalk& walk, const WalkedCell& cell, double sigma);

/// Appends the spans of the walk's parameter in which the trilinear function of eight corner values is at most sigma.
void appendCellSpans(const std::array<double, 8>& corners, const GridWalk& walk, const WalkedCell& cell, double sigma,
                     Intervals& intervals);

}  // namespace sdf_ccd
