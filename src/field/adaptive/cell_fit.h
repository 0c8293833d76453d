#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "field/adaptive/adaptive_grid.h"
#include "field/cube_corner.h"
#include "field/gradient_bound.h"
#include "field/near_octants.h"

namespace sdf_ccd {

/// A leaf, and a bound on its |interpolated − true distance| [m].
struct FittedLeaf {
  LeafWord word = 0;
  double error = 0.0;
};

/// A cell's signed distances at a lattice of 9×9×9 points, computed when needed, and the proofs of leaves for the
/// cell.
///
/// The proof. In every part of the cell, a leaf's interpolant is the trilinear one of its values at the part's corners,
/// so GradientBound bounds its error there. Parts are divided until the leaf is proved: smaller parts have fewer
/// triangles near them.
class CellFit {
 public:
  /// @param near  of the cell.
  explicit CellFit(const NearTriangles& near);

  /// For one of the 4×4×4 parts of another cell, reusing its distances.
  CellFit(const NearTriangles& near, CellFit& around, const Vector3i& part);

  /// A leaf for the cell, or for its octant k, if it is proved to differ by at most `max_deviation` [m] from φ in it.
  std::optional<FittedLeaf> leaf(const LeafScale& scale, double max_deviation);
  std::optional<FittedLeaf> octantLeaf(int k, const LeafScale& scale, double max_deviation);

  /// The leaf of the exact distances at an octant's corners, rounded; its bound holds for any 1-Lipschitz function.
  FittedLeaf roundedLeaf(int k, const LeafScale& scale);

  NearOctants& octants();

 private:
  static constexpr int kSteps = 16;  ///< along the cell's side
  static constexpr int kKept = 2;    ///< distances are kept at every second step

  /// A cube of the cell: first corner and side, in steps.
  struct Cube {
    Vector3i low;
    int side;
  };
  using CornerValues = GradientBound::CornerValues;
  using Lattice = std::array<double, 27>;  ///< of a cube: corners and middles between them, x fastest

  static constexpr int kSide = kSteps / kKept + 1;  ///< points that are kept along each side

  static int index(const Vector3i& p) { return (p.x() + kSide * (p.y() + kSide * p.z())) / kKept; }
  Vector3d point(const Vector3i& p) const { return low_ + step_ * p.cast<double>(); }
  /// Signed distance at a point that is kept: NaN if it is not computed yet.
  double at(const Vector3i& point) const { return values_[index(point)]; }
  void set(const Vector3i& point, double distance) { values_[index(point)] = distance; }
  static Cube octantCube(int k) { return {kSteps / 2 * cubeCorner(k), kSteps / 2}; }
  std::optional<FittedLeaf> leaf(const Cube& cube, const NearTriangles& near, const LeafScale& scale,
                                 double max_deviation);
  /// Computes the missing distances at the cube's points, steps + 1 along each side.
  void sample(const Cube& cube, int steps, const NearTriangles& near);
  /// The distances at the corners of a cube, which must have been computed before.
  CornerValues cornersOf(const Cube& cube) const;
  /// The distances at the points of a cube.
  Lattice latticeOf(const Cube& cube, const NearTriangles& near);
  /// latticeOf() a cube of two steps, whose middle points are not kept.
  Lattice finestLattice(const Cube& cube, const NearTriangles& near) const;
  /// Bounds interpolant − φ in a cube. The result is proved if it is at most `max_deviation`; else it only says that no
  /// such bound was proved.
  /// @param exact  the distances at the cube's points.
  /// @param leaf   the interpolant's values at the cube's corners.
  Deviation deviation(const Cube& cube, const NearTriangles& near, const GradientBound& bound, const Lattice& exact,
                      const CornerValues& leaf, double max_deviation);
  Deviation deviationInParts(const Cube& cube, const NearTriangles& near, const GradientBound& bound,
                             const Lattice& exact, const CornerValues& leaf, double max_deviation);

  const NearTriangles& near_;
  std::optional<NearOctants> octants_;
  Vector3d low_;
  double step_;
  std::array<double, kSide * kSide * kSide> values_;  ///< NaN: not computed yet
};

}  // namespace sdf_ccd
