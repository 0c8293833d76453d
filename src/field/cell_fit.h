#pragma once

#include <array>
#include <cstdint>

#include "near_triangles.h"
#include "sdf_ccd/field/adaptive_grid.h"

namespace sdf_ccd {

/// A cell's signed distances at a lattice of 9×9×9 places, taken when asked for, and what they prove about leaves that
/// would stand in its place.
///
/// The proof. Let the gradient of φ lie in a cone with axis a and sine s over a cube of side w. Then φ less a linear
/// function has a gradient of at most s, so that trilinear interpolation of its corners is wrong by at most √3/2 w s
/// (design §3.3; a linear function is interpolated exactly). A leaf's interpolant equals that of its own values at the
/// cube's corners: its error is at most the largest error at the corners plus √3/2 w s. Flat surface: s = 0.
class CellFit {
 public:
  static constexpr int kSteps = 8;

  /// A cube of the lattice: first corner and side, in steps.
  struct Cube {
    Vector3i low;
    int side;
  };

  CellFit(const NearTriangles& near, const Vector3d& low, double side);

  /// Signed distance at a lattice place.
  double at(const Vector3i& place);
  void set(const Vector3i& place, double distance) { values_[index(place)] = distance; }

  /// A leaf for this cube (of side 8 or 4): its word, if it is proved to differ by at most `error` from φ in it.
  bool leaf(const Cube& cube, const LeafScale& scale, double error, LeafWord& word);

  /// The same without proof: the exact distances at the corners, rounded.
  LeafWord roundedLeaf(const Cube& cube, const LeafScale& scale);

  Vector3d place(const Vector3i& p) const { return low_ + step_ * p.cast<double>(); }

 private:
  static int index(const Vector3i& p) { return p.x() + 9 * (p.y() + 9 * p.z()); }
  std::array<double, 8> cornersOf(const Cube& cube);
  double sine(const Cube& cube);
  bool proved(const Cube& leaf, const std::array<double, 8>& corners, const Cube& cube, double error);

  const NearTriangles& near_;
  Vector3d low_;
  double step_;
  std::array<double, 729> values_;   ///< NaN: not taken yet
  std::array<double, 1 + 8> sines_;  ///< of the cell and its halves; negative: not asked yet
};

}  // namespace sdf_ccd
