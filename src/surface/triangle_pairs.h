#pragma once

#include <array>

#include "mesh/corners.h"

namespace sdf_ccd {

/// Pairs of triangles that are tested together: corners of A in its frame, of B in its own.
struct TrianglePairs {
  static constexpr int kSize = 8;
  using Lane = std::array<double, kSize>;
  using Vectors = std::array<Lane, 3>;  ///< by coordinate

  alignas(64) std::array<Vectors, 3> a{}, b{};  ///< by corner [m]
  alignas(64) Lane gap;                         ///< the result: as gapAlong(), the smaller of both poses [m]
  alignas(64) Vectors axis;                     ///< the result: direction of the gap, frame A, unit
  alignas(64) Lane distance2;                   ///< the result of closestGaps(): halfway between both poses [m²]
  int size = 0;                                 ///< lanes in use

  void add(const CornerPointers& corners_a, const CornerPointers& corners_b) {
    const int i = size++;
    for (int corner = 0; corner < 3; ++corner)
      for (int k = 0; k < 3; ++k) {
        a[corner][k][i] = (*corners_a[corner])[k];
        b[corner][k][i] = (*corners_b[corner])[k];
      }
  }
  void add(const Corners& corners_a, const Corners& corners_b) { add(pointersTo(corners_a), pointersTo(corners_b)); }

  /// Copies one pair of another group.
  void add(const TrianglePairs& from, int i) {
    for (int corner = 0; corner < 3; ++corner)
      for (int k = 0; k < 3; ++k) {
        a[corner][k][size] = from.a[corner][k][i];
        b[corner][k][size] = from.b[corner][k][i];
      }
    ++size;
  }
  Vector3d axisOf(int i) const { return {axis[0][i], axis[1][i], axis[2][i]}; }
};

/// Poses of B in A at both ends of an interval.
struct EndPoses {
  Isometry3d X_AB_start, X_AB_end;
};

/// Gaps at both ends: along the triangles' normals and a given direction of A's frame, whichever is largest.
void planeGaps(const EndPoses& poses, const Vector3d& direction_A, TrianglePairs& pairs);

/// The same along the segment between the closest points of A and of B, with each corner of B halfway between its
/// positions at both ends: the gap along it is nearly the largest.
void closestGaps(const EndPoses& poses, TrianglePairs& pairs);

/// Raises gaps that are known to those across edges, in the planes of the faces: closest points give no gap where
/// triangles slide along each other by more than they are apart.
void edgeGaps(const EndPoses& poses, TrianglePairs& pairs);

}  // namespace sdf_ccd
