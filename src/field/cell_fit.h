#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "near_triangles.h"
#include "sdf_ccd/field/adaptive_grid.h"

namespace sdf_ccd {

/// A cell's signed distances at a lattice of 9×9×9 places, taken when asked for, and what they prove about leaves that
/// would stand in its place.
///
/// The proof. Where the gradients of φ in a cube lie close together, trilinear interpolation of its corners is hardly
/// wrong: see NearTriangles::interpolationError(). A leaf's interpolant equals that of its own values at the cube's
/// corners: its error is at most the largest error at the corners plus that. Flat surface: nothing is added.
class CellFit {
 public:
  static constexpr int kSteps = 8;

  /// A cube of the lattice: first corner and side, in steps.
  struct Cube {
    Vector3i low;
    int side;
  };

  /// @param near  of the cell.
  explicit CellFit(const NearTriangles& near);

  /// For one of the 4×4×4 parts of another cell, with what is known of it there.
  CellFit(const NearTriangles& near, CellFit& around, const Vector3i& part);

  /// Signed distance at a lattice place: NaN if it was not asked for yet.
  double at(const Vector3i& place) const { return values_[index(place)]; }
  void set(const Vector3i& place, double distance) { values_[index(place)] = distance; }

  /// A leaf for the cell, or for its octant k: its word, if it is proved to differ by at most `error` from φ in it.
  bool leaf(const LeafScale& scale, double error, LeafWord& word);
  bool octantLeaf(int k, const LeafScale& scale, double error, LeafWord& word);

  /// The same without proof: the exact distances at the corners, rounded.
  LeafWord roundedLeaf(int k, const LeafScale& scale);

  NearOctants& octants();

 private:
  using Corners = std::array<double, 8>;

  static int index(const Vector3i& p) { return p.x() + 9 * (p.y() + 9 * p.z()); }
  static Cube octantCube(int k) { return {kSteps / 2 * Vector3i(k & 1, (k >> 1) & 1, k >> 2), kSteps / 2}; }
  bool leaf(const Cube& cube, const NearTriangles& near, const LeafScale& scale, double error, LeafWord& word);
  /// Takes the distances that are missing at the cube's places, steps + 1 along each side.
  void take(const Cube& cube, int steps, const NearTriangles& near);
  Corners cornersOf(const Cube& cube) const;
  /// Whether an interpolant with these values at the cube's corners differs by at most `error` from φ in the cube.
  bool proved(const Cube& cube, const NearTriangles& near, const Corners& leaf, double error);
  bool provedInParts(const Cube& cube, const NearTriangles& near, const Corners& leaf, double error);
  /// Whether errors at a cube's corners say that an interpolant is wrong by at most `error` all over it.
  bool holds(const Corners& errors, int side, const NearTriangles& near, double error) const;

  const NearTriangles& near_;
  std::optional<NearOctants> octants_;
  Vector3d low_;
  double step_;
  std::array<double, 729> values_;  ///< NaN: not taken yet
};

}  // namespace sdf_ccd
