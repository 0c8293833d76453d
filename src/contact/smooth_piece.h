#pragma once

#include <array>

#include "field/cell_reader.h"
#include "query/cells/cell_cubic.h"

namespace sdf_ccd {

/// Weights with which a quadratic function of u is the sum of its values at 0, ½ and 1.
constexpr std::array<double, 3> quadraticWeights(double u) {
  return {(1.0 - u) * (1.0 - 2.0 * u), 4.0 * u * (1.0 - u), u * (2.0 * u - 1.0)};
}

/// A field along a straight piece of a path on which the distance is a cubic: in a cell of a grid, next to one face of
/// a box, in a half-space.
struct SmoothPiece {
  CellCubic distance;        ///< [m], of u from 0 at the piece's start to 1 at its end
  Vector3d gradient_first;   ///< at its start
  Vector3d gradient_middle;  ///< halfway
  Vector3d gradient_last;    ///< at its end

  /// At u: along a line, the gradient of a trilinear function is quadratic.
  Vector3d gradient(double u) const {
    const auto [first, middle, last] = quadraticWeights(u);
    return first * gradient_first + middle * gradient_middle + last * gradient_last;
  }
};

/// Reads such pieces from one field. Successive pieces are mostly in the same cell, which is read once.
class SmoothPieceReader {
 public:
  /// @param cells  of the field; must outlive this, like the field.
  SmoothPieceReader(const DistanceField& field, CellReader& cells) : cells_(cells), primitive_(field.primitive()) {}

  /// The whole path from one point to another [m]. @return false if it is not one smooth piece, or not known to be one.
  bool readWay(const Vector3d& from, const Vector3d& to, SmoothPiece& piece);

  /// What lies between two of smoothPieces()'s breaks, whose rounding may leave them in a neighbouring cell.
  /// @return false where the field has no corner values, and in round primitives.
  bool readPiece(const Vector3d& from, const Vector3d& to, SmoothPiece& piece);

 private:
  void readCell(const CellLine& line, SmoothPiece& piece) const;

  CellReader& cells_;
  const Primitive* primitive_;
};

}  // namespace sdf_ccd
