#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

using Vector2d = Eigen::Vector2d;

/// A corner of a flat piece: in the piece's plane, and in space.
struct FlatCorner {
  Vector2d at;
  Vector3d point;
  int vertex = -1;  ///< of the mesh; -1 for a corner made by a cut
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
  /// Least distance of a point to the lines through the sides: negative outside.
  double depth(const Vector2d& x) const;

  /// Length of the intersection of a segment with the piece shrunk by `border`; negative if it is empty, 0 for a single
  /// point.
  double chord(const Vector2d& from, const Vector2d& to, double border) const;

  /// The intersection of a triangle with the piece shrunk by `border`.
  std::vector<Vector2d> common(const std::array<Vector2d, 3>& triangle, double border) const;

  /// The parts before and behind a line. Corners within `snap` of the line belong to both.
  std::array<FlatPiece, 2> cut(const FlatLine& line, double snap) const;

  /// Triangles that cover it, as indices of corners: a fan about the corner for which the narrowest triangle is widest.
  std::vector<std::array<int, 3>> triangles() const;

 private:
  std::vector<FlatCorner> corners_;
  std::vector<FlatLine> sides_;  ///< from each corner to the next; normals point into the piece
};

}  // namespace sdf_ccd
