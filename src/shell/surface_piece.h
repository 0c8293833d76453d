#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "mesh/corners.h"

namespace sdf_ccd {

/// A triangular piece of a surface that is halved until a decision about it is possible.
struct SurfacePiece {
  Corners corners;

  static SurfacePiece of(const TriangleMesh& mesh, int triangle) { return {cornersOf(mesh, triangle)}; }

  double area() const { return areaNormal(corners).norm() / 2; }

  /// Index of the corner opposite the longest edge, and that edge's squared length.
  std::pair<int, double> longestEdge() const {
    std::pair<int, double> longest{0, -1.0};
    for (int i = 0; i < 3; ++i) {
      const double length2 = (corners[(i + 2) % 3] - corners[(i + 1) % 3]).squaredNorm();
      if (length2 > longest.second) longest = {i, length2};
    }
    return longest;
  }

  /// The two halves, cut from the middle of the longest edge to the opposite corner.
  std::pair<SurfacePiece, SurfacePiece> halves() const {
    const int corner = longestEdge().first, next = (corner + 1) % 3, last = (corner + 2) % 3;
    std::pair<SurfacePiece, SurfacePiece> result{*this, *this};
    result.first.corners[last] = result.second.corners[next] = (corners[next] + corners[last]) / 2;
    return result;
  }

  /// Largest distance of the piece from q, squared: distance is convex, so a corner has it.
  double farthest2(const Vector3d& q) const {
    return std::max({(corners[0] - q).squaredNorm(), (corners[1] - q).squaredNorm(), (corners[2] - q).squaredNorm()});
  }

  /// The number of slices across the piece that are about as long as wide, but at least `least` [m] long; 1 for a piece
  /// that is not much longer than both.
  double slices(double least) const {
    constexpr double kFarLonger = 8;
    const double longest = std::sqrt(longestEdge().second);
    if (longest <= kFarLonger * least) return 1;
    const double count = longest / std::max(least, 2 * area() / longest);
    return count > kFarLonger ? std::ceil(count) : 1;
  }
};

/// Cuts a triangle into `count` slices, from its corner 0 on, and calls visit(piece) for the triangles of each.
template <typename Visit>
void forEachSlice(const SurfacePiece& triangle, double count, Visit visit) {
  const auto& [tip, left_end, right_end] = triangle.corners;
  Vector3d left = tip, right = tip;
  for (std::int64_t k = 1; k <= static_cast<std::int64_t>(count); ++k) {
    const double share = double(k) / count;
    const Vector3d next_left = tip + share * (left_end - tip), next_right = tip + share * (right_end - tip);
    visit(SurfacePiece{{left, next_left, next_right}});
    if (k > 1) visit(SurfacePiece{{left, next_right, right}});
    left = next_left;
    right = next_right;
  }
}

/// Calls visit(piece) for pieces that cover a triangle: the triangle itself, or the slices of a sliver. Halving a
/// sliver instead cuts it lengthwise too, so that pieces of 1/n of its length would be n^1.6 in number.
template <typename Visit>
void forEachCompactPiece(const SurfacePiece& triangle, double least, Visit visit) {
  const double slices = triangle.slices(least);
  if (slices == 1) {
    visit(triangle);
    return;
  }
  const auto [corner, longest2] = triangle.longestEdge();
  const Vector3d &top = triangle.corners[corner], &from = triangle.corners[(corner + 1) % 3],
                 &to = triangle.corners[(corner + 2) % 3];
  const double share = (top - from).dot(to - from) / longest2;
  const Vector3d foot = from + share * (to - from);
  forEachSlice({{from, foot, top}}, std::max(1.0, std::ceil(share * slices)), visit);
  forEachSlice({{to, foot, top}}, std::max(1.0, std::ceil((1 - share) * slices)), visit);
}

}  // namespace sdf_ccd
