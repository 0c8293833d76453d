#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

using Vector2d = Eigen::Vector2d;

/// A corner of a flat piece: in the piece's plane, and in space.
struct FlatCorner {
  Vector2d at;
  Vector3d place;
  int vertex = -1;  ///< of the mesh; -1 for one that a cut has made
};

/// A line in the plane: where normal · x = offset.
struct FlatLine {
  Vector2d normal = Vector2d::Zero();  ///< of length one
  double offset = 0.0;

  double distance(const Vector2d& x) const { return normal.dot(x) - offset; }
  static FlatLine through(const Vector2d& point, const Vector2d& along);
};

/// A convex polygon in a plane, corners counter-clockwise.
class FlatPiece {
 public:
  FlatPiece() = default;
  explicit FlatPiece(std::vector<FlatCorner> corners);

  const std::vector<FlatCorner>& corners() const { return corners_; }
  Vector2d centroid() const;
  /// Least distance of a place from the border, as far as lines go: negative outside.
  double depth(const Vector2d& x) const;

  /// Length of what a segment has in common with the part of the piece that is `border` away from its border; negative
  /// if there is no such place. A single place has length 0.
  double chord(const Vector2d& from, const Vector2d& to, double border) const;

  /// Of a triangle, the part within that same part of the piece.
  std::vector<Vector2d> common(const std::array<Vector2d, 3>& triangle, double border) const;

  /// What is before and behind a line. Corners within `snap` of it belong to both.
  std::array<FlatPiece, 2> cut(const FlatLine& line, double snap) const;

  /// Triangles that cover it, as corners' indices: fans about the corner that makes the least of them widest.
  std::vector<std::array<int, 3>> triangles() const;

 private:
  std::vector<FlatCorner> corners_;
  std::vector<FlatLine> sides_;  ///< from each corner to the next; normals point into the piece
};

}  // namespace sdf_ccd
