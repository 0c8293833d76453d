#pragma once

#include <algorithm>
#include <array>

#include "near_triangles.h"

namespace sdf_ccd {

/// Upper bounds of an interpolant's deviation above φ, and below it [m].
struct Deviation {
  double above = 0.0, below = 0.0;

  double largest() const { return std::max(above, below); }
  void include(const Deviation& other) {
    above = std::max(above, other.above);
    below = std::max(below, other.below);
  }
};

/// Bounds the error of an interpolant in a cube by the gradients of φ there.
///
/// From a corner a to a point x the distance grows at least by m(x − a), with m(v) the minimum of g·v over all
/// gradients g in the cube: φ(x) ≥ φ(a) + m(x − a). That holds for each corner, hence for weighted means of two
/// of them. The right-hand side is concave, so that it is nowhere below the interpolation of its values at the cube's
/// corners. Its difference from the interpolant is largest at a corner, which bounds the error above φ. The two are
/// diagonally opposite corners, with the best weights: where the surface has one edge, their two planes are those of
/// its faces, and the bound is tight. The error below φ is bounded likewise, by the maximum growth.
///
/// A gradient is a sum of the near triangles' normals whose weights sum to between 1 and 1 / cos of their cone's angle;
/// if the normals are not in one cone, only |g| ≤ 1 is known.
class GradientBound {
 public:
  using CornerValues = std::array<double, 8>;

  explicit GradientBound(const NearTriangles& near);

  /// Bounds on interpolant − φ in a cube that lies within the cube of the constructor's triangles.
  /// @param side    of the cube [m].
  /// @param exact   φ at the cube's corners [m].
  /// @param values  the interpolant at the cube's corners [m].
  /// @param enough  bounds below these are not tightened further.
  Deviation deviation(double side, const CornerValues& exact, const CornerValues& values,
                      const Deviation& enough = {}) const;

 private:
  using Lanes = std::array<float, 8>;  ///< see gradient_bound.cpp

  /// Per corner k of a cube of side 1: lower bounds of the distance's growth from each pair's first (second) corner to
  /// corner k, then from corner k to those.
  alignas(64) std::array<Lanes, 8> from_low_, from_high_;
  double max_growth_ = 0.0;  ///< the largest of their absolute values
};

}  // namespace sdf_ccd
