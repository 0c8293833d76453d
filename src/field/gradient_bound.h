#pragma once

#include <algorithm>
#include <array>

#include "near_triangles.h"

namespace sdf_ccd {

/// How far an interpolant is above φ, and below it, at most [m].
struct Deviation {
  double above = 0.0, below = 0.0;

  double largest() const { return std::max(above, below); }
  void include(const Deviation& other) {
    above = std::max(above, other.above);
    below = std::max(below, other.below);
  }
};

/// What the gradients of φ in a cube say of the error of an interpolant there.
///
/// On the way from a corner a to a point x the distance grows at least by m(x − a), m(v) the least of g·v over all
/// gradients g in the cube: φ(x) ≥ φ(a) + m(x − a). That holds for each corner, hence for means of what two of them
/// say. The right-hand side is concave, so that it is nowhere below what is interpolated between its values at the
/// cube's corners. An interpolant, less that: its largest value at a corner bounds how far it is above φ. Two corners
/// that lie across from each other, and the right weights: where the surface has one edge, their two planes are those
/// of its faces, and the bound is what the edge demands. Below φ alike, with the most that the distance grows.
///
/// A gradient is a sum of the near triangles' normals whose weights sum up to 1 to 1 / cos of their cone's angle; where
/// these are not in one cone, it is only known that |g| ≤ 1.
class GradientBound {
 public:
  using Corners = std::array<double, 8>;

  explicit GradientBound(const NearTriangles& near);

  /// Bounds on interpolant − φ in a cube within near's.
  /// @param side    of the cube [m].
  /// @param exact   φ at the cube's corners [m].
  /// @param values  the interpolant's there [m].
  /// @param enough  bounds below these are not made tighter.
  Deviation deviation(double side, const Corners& exact, const Corners& values, const Deviation& enough = {}) const;

 private:
  using Lanes = std::array<float, 8>;  ///< see gradient_bound.cpp

  /// By how much the distance grows at least from the pairs' first (second) corners to corner k, or from there to them,
  /// for a side of 1.
  alignas(64) std::array<Lanes, 8> from_low_, from_high_;
  double most_growth_ = 0.0;  ///< the largest of their absolute values
};

}  // namespace sdf_ccd
