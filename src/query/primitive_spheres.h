#pragma once

#include "motion/chords.h"
#include "query/lanes/sphere_lanes.h"
#include "query/swept_side.h"
#include "sdf_ccd/primitive.h"

namespace sdf_ccd {

/// Finds the side of a primitive's surface on which spheres of a shell surely stay along a chord, a vector at a time:
/// conservative, as sweptSide() with the radius added to its margin, but for the paths' middles.
class PrimitiveSpheres {
 public:
  /// @param primitive, chord  must outlive this.
  /// @param shell             contains the spheres' centres, frame P.
  PrimitiveSpheres(const Primitive& primitive, const Chord& chord, double margin, const BoundingBall& shell);

  /// Sets the sides of a group's spheres.
  void test(SphereGroup& group) const;

  /// What test() uses.
  struct Sweep {
    Isometry3d start, end;  ///< X_FP
    double margin;          ///< rounding included [m]
  };

 private:
  const Primitive& primitive_;
  Sweep sweep_;
};

}  // namespace sdf_ccd
