#pragma once

#include <optional>

#include "primitive_spheres.h"
#include "query/lanes/sphere_lanes.h"
#include "query/swept_side.h"

namespace sdf_ccd {

/// Finds the side of a field's surface on which a shell's spheres surely stay along a whole chord: sweptSide() with the
/// spheres' radii added to the margin.
class SphereSides {
 public:
  /// @param margin  added to the spheres' radii [m].
  /// @param shell   contains the spheres' centres, frame P.
  SphereSides(const DistanceField& field, double margin, const BoundingBall& shell);

  /// Sets the chord of the spheres that follow.
  void begin(const Chord& chord);

  /// The side of one sphere.
  SweptSide of(const Vector3d& center_P, double radius) const;

  /// Whether groups are tested in vectors: each sphere of a group then costs a few times less.
  bool inVectors() const { return vectors_ || field_.primitive(); }

  /// Whether it is faster to test points in groups too: not on long paths, which need an empty sphere every few units.
  bool sortsPoints() const;

  /// This thread's group: fill it, then call testGroup().
  SphereGroup& group() { return group_; }
  void testGroup();

 private:
  struct Vectors;

  const DistanceField& field_;
  double margin_;
  BoundingBall shell_;
  const Chord* chord_ = nullptr;
  SphereGroup& group_;
  std::optional<PrimitiveSpheres> primitive_;
  Vectors* vectors_ = nullptr;  ///< this thread's, for grids
};

}  // namespace sdf_ccd
