#pragma once

#include "query/lanes/sphere_lanes.h"

namespace sdf_ccd {

/// On which side of a field's surface spheres of a shell surely are all along a chord, as sweptSide() with the radius
/// added to the margins.
class SphereSides {
 public:
  /// @param margins  of the spheres' surfaces.
  /// @param shell    holds their centres, frame P.
  SphereSides(const DistanceField& field, const SweptMargins& margins, const BoundingBall& shell);

  /// The chord that spheres are asked about from now on.
  void begin(const Chord& chord);

  /// Of one sphere.
  SweptSide of(const Vector3d& center_P, double radius) const;

  /// Whether groups are asked in vectors: each sphere of one then costs a few times less.
  bool inVectors() const { return vectors_ != nullptr; }

  /// Whether that is worth its while for points too: not for long ways, as their spheres are asked of every few units.
  bool sortsPoints() const;

  /// To be filled, then answered; this thread's.
  SphereGroup& group() { return group_; }
  void askGroup();

 private:
  struct Vectors;

  const DistanceField& field_;
  SweptMargins margins_;
  BoundingBall shell_;
  const Chord* chord_ = nullptr;
  SphereGroup& group_;
  Vectors* vectors_ = nullptr;  ///< this thread's
};

}  // namespace sdf_ccd
