#pragma once

#include <array>
#include <cstdint>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/motion/chords.h"
#include "sdf_ccd/query/segment_query.h"
#include "segment_lanes.h"

namespace sdf_ccd {

/// Spheres of a shell that are asked together; points are spheres of no radius.
struct SphereGroup {
  static constexpr int kCapacity = 256;
  template <class T>
  using Column = std::array<T, kCapacity + RayQueue::kSlack>;

  std::array<Column<float>, 3> center;  ///< [m], frame P
  Column<float> radius;                 ///< [m]
  Column<std::int32_t> side;            ///< the answer: a SweptSide
  int size = 0;

  void add(const Vector3d& p_P, double r) {
    for (int k = 0; k < 3; ++k) center[k][size] = static_cast<float>(p_P[k]);
    radius[size++] = static_cast<float>(r);
  }
  SweptSide sideOf(int i) const { return static_cast<SweptSide>(side[i]); }
};

/// A chord in a grid, as vector code reads it: lengths in units, places from the grid's origin.
struct SphereSweep {
  /// @param margins  of the spheres' surfaces.
  /// @param shell    holds their centres, frame P.
  SphereSweep(const DistanceField& field, const LaneBox& box, const Chord& chord, const SweptMargins& margins,
              const BoundingBall& shell);

  /// Ways are much longer than most balls that are free of surface: they are followed from ball to ball. (Up to here
  /// it costs less to ask about the middle only: measured.)
  bool isLong() const { return longest_way > 4.0F * LaneBox::kUnits; }

  /// Of a place (x, y, z, 1) [m]: where it is at the chord's middle, and its way from there to the end.
  std::array<std::array<float, 4>, 3> middle, way;
  float longest_way;      ///< no sphere's is longer
  float rounding;         ///< what single precision may move a place by; not finite where it is good for nothing
  float outside, inside;  ///< margins
  std::array<float, 3> surface_low, surface_high;  ///< box around the surface
};

/// A vector's lanes, and what they wait for; reused.
struct SphereWork {
  RayQueue waiting;
  Fetched fetched;
};

/// On which side of the surface each sphere surely is all along a chord, as sweptSide() with the radius added to its
/// margins; conservative too. Uniform grids: those whose samples are distances (UniformLanes::exact).
void sweepSpheres(const AdaptiveLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work);
void sweepSpheres(const UniformLanes& grid, const SphereSweep& sweep, SphereGroup& group, SphereWork& work);

}  // namespace sdf_ccd
