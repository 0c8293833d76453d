#pragma once

#include <array>
#include <cstdint>

#include "motion/chords.h"
#include "query/swept_side.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "segment_lanes.h"

namespace sdf_ccd {

/// Spheres of a shell that are tested together; points are spheres of radius zero.
struct SphereGroup {
  static constexpr int kCapacity = 256;
  template <class T>
  using Column = std::array<T, kCapacity + RayQueue::kSlack>;

  std::array<Column<float>, 3> center;  ///< [m], frame P
  Column<float> radius;                 ///< [m]
  Column<std::int32_t> side;            ///< the result: a SweptSide
  int size = 0;

  void add(const Vector3f& p_P, float r) {
    for (int k = 0; k < 3; ++k) center[k][size] = p_P[k];
    radius[size++] = r;
  }
  void add(const Vector3d& p_P, double r) { add(p_P.cast<float>(), static_cast<float>(r)); }
  SweptSide sideOf(int i) const { return static_cast<SweptSide>(side[i]); }
};

/// A chord in a grid, as read by vector code: lengths in units, points relative to the grid's origin.
struct SphereSweep {
  /// @param margin  added to the spheres' radii [m].
  /// @param shell   contains the spheres' centres, frame P.
  SphereSweep(const DistanceField& field, const LaneBox& box, const Chord& chord, double margin,
              const BoundingBall& shell);

  /// Whether paths are much longer than most empty spheres: then they are followed from one to the next. (Up to this
  /// length it costs less to test the middle only: measured.)
  bool isLong() const { return max_displacement > 4.0F * LaneBox::kUnits; }

  /// Transforms of a point (x, y, z, 1) [m]: to its position at the chord's middle; to its displacement from there.
  std::array<std::array<float, 4>, 3> middle, displacement;
  float max_displacement;  ///< upper bound of the spheres' displacements from their positions at the middle
  float rounding;          ///< upper bound of the error of single precision; not finite if that is too large
  float margin;            ///< added to the spheres' radii
  std::array<float, 3> surface_low, surface_high;  ///< box around the surface
};

/// One vector's queue; reused.
struct SphereWork {
  RayQueue waiting;
  Fetched fetched;
};

/// Finds the side of the surface on which each sphere surely stays along a whole chord, as sweptSide() with the radius
/// added to its margin; conservative too.
void sweepSpheres(const AdaptiveLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work);
void sweepSpheres(const UniformLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work);

}  // namespace sdf_ccd
