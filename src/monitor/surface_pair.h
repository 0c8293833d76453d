#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "containment.h"
#include "relative_motion.h"
#include "scene/body_triangles.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Decides a pair by the surfaces of both bodies, exactly up to the errors of the motions (design §3.17): whether they
/// stay apart or certainly cross. One body may have half-spaces, instead of triangles or as well.
class SurfacePair {
 public:
  /// The bodies must satisfy haveSurfaces(), and outlive this.
  /// @param resolution  surfaces closer than this may remain undecided [m].
  SurfacePair(const Body& a, const Body& b, double resolution);

  /// Sets the motion over a part of a cycle. @param bounds  see RelativeMotion::set().
  void setMotion(const PairMotion& pair, std::vector<RelativeMotionBounds>& bounds);

  /// Of the smaller body relative to the larger one, or to the half-space.
  const RelativeMotion& motion() const { return motion_; }

  /// Whether there is nothing but a single half-space on one side.
  bool isWithHalfSpace() const { return planes_.size() == 1 && !field_->triangles; }

  /// Upper bound of the distance between the triangles, or plane, and the true surfaces, both bodies together [m].
  double deviation() const { return deviation_; }

  /// Surfaces closer than this, beyond the errors of triangles and motion, may remain undecided [m].
  double resolution() const { return resolution_; }

  /// Radius of the smaller body's ball [m]: distances beyond it need not be accurate.
  double size() const { return shell_->ball.radius; }

  /// Lower bound of the surfaces' distance at a pose, from the bodies' balls alone [m].
  double ballClearance(const Isometry3d& X_FP) const;

  /// Removes the witnesses of the last query, so that answers depend on the arguments alone.
  void forget() { witness_ = closed_witness_ = {}; }

  struct Answer {
    SeparationState state = SeparationState::kOpen;
    double clearance = 0.0;                ///< if apart: lower bound of the distance at the motion's end [m]
    bool far = false;                      ///< if apart: even the bodies' balls are
    std::optional<ContactPoint> crossing;  ///< if crossing
    /// If open: the distance falls to at most all errors plus this [m]; infinite if that is not known. With a
    /// half-space it is known, and no point is deeper than that either.
    double open_within = kInfinity;
  };

  /// @param motion_error  upper bound of the error of the bodies' relative position [m].
  Answer decide(double motion_error, SeparationMemory& memory);

  /// A certain crossing of the surfaces at a time of the motion [s]; empty if none is found.
  std::optional<ContactPoint> crossingAt(double time, double motion_error, SeparationMemory& memory);

  /// A touch of the surfaces [s].
  struct Touch {
    double apart;                    ///< they are apart from the start of the search up to this time
    std::optional<double> crossing;  ///< and certainly cross then; empty if no crossing is certain
  };

  /// The first touch from one time of the motion to another, which may be before it. Unless they graze, the surfaces
  /// move by no more than the resolution between the two times. Empty if they are apart all the time, also if one body
  /// is wholly inside the other.
  std::optional<Touch> touch(double from, double to, double motion_error, SeparationMemory& memory);

  /// Whether a body has a component wholly inside the other, at a pose at which the surfaces are apart.
  /// @param attempt  see containmentOf().
  Containment containment(const Isometry3d& X_FP, int attempt = 0) const;

  /// The contact at a point that is inside at any time of the motion. The surfaces must be apart during all of it: so
  /// it is inside all the time.
  ContactPoint contactInside(const InsidePoint& inside) const;

  /// Looks at a few times of the motion for a certain crossing, and at its end for a point of one body's surface inside
  /// the other, deeper than all errors. decide() may find none where surfaces also graze each other, or cross without
  /// an edge that certainly pierces a triangle: bricks whose sides are flush. Empty if none is found.
  std::optional<ContactPoint> findContact(double motion_error, SeparationMemory& memory);

 private:
  Vector3d fromAToB(const Vector3d& from_f_to_p) const { return f_is_a_ ? from_f_to_p : Vector3d(-from_f_to_p); }

  /// The surfaces, with the caps that close openings or without.
  Separation test(bool closed, const TwoBodyMotion& motion, const SeparationOptions& options, SeparationMemory& memory);
  Separation testCloser(bool closed, const TwoBodyMotion& motion, SeparationOptions options, SeparationMemory& memory);
  Answer decideNear(double margin, SeparationMemory& memory);
  Answer decideBy(bool closed, double margin, SeparationMemory& memory);
  bool isBelowThroughout(double margin, SeparationMemory& memory);
  bool isBelow(const TwoBodyMotion& motion, double start, double end, double margin, SeparationMemory& memory);
  Separation during(std::size_t step, double start, double end, double motion_error, SeparationMemory& memory);
  ContactPoint contactAt(const Separation& found, std::size_t step, double share) const;
  ContactPoint contactAtEnd(const InsidePoint& inside) const;

  bool f_is_a_;
  const Body *field_, *shell_;  // bodies F and P; P is the smaller one, or F the half-space
  RelativeMotion motion_;
  double deviation_;
  double resolution_;
  const std::vector<BodyHalfSpace>& planes_;  // of F
  int poses_left_ = 0;                        // that may be tested against a half-space in this motion
  bool found_plane_ = false;                  // the last crossing is with a half-space
  SeparationWitness witness_, closed_witness_;
};

}  // namespace sdf_ccd
