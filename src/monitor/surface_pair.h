#pragma once

#include <optional>

#include "body/body_triangles.h"
#include "query/separation.h"
#include "relative_motion.h"
#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// Decides a pair by the triangles of both bodies, exactly but for what motions are known to (design §3.17): whether
/// their surfaces stay apart or surely cross.
class SurfacePair {
 public:
  /// Of a pair that hasTriangles().
  /// @param resolution  surfaces nearer to each other than this may be left open [m].
  SurfacePair(const Scene& scene, const PlannedPair& pair, double resolution);

  /// Takes the motion over a part of a cycle, of bodies that can be followed.
  /// @param bounds  see RelativeMotion::take().
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, std::vector<RelativeMotionBounds>& bounds) {
    motion_.take(bodies, span, bounds);
  }

  /// Of the smaller body against the larger one.
  const RelativeMotion& motion() const { return motion_; }

  /// What the triangles are off by from the surfaces [m].
  double deviation() const { return deviation_; }

  /// What is nearer than this, beyond the errors of triangles and motion, may be left open [m].
  double resolution() const { return resolution_; }

  /// Of the ball around the smaller body: what is farther away than that need not be known well [m].
  double size() const { return shell_->ball.radius; }

  /// Lower bound of the surfaces' distance at a pose, by balls around them alone [m].
  double ballClearance(const Isometry3d& X_FP) const;

  /// Forgets where the last motion was looked at first: answers depend on what is asked alone then.
  void forget() { witness_ = closed_witness_ = {}; }

  /// Looks where another one did first, of the same bodies.
  void take(const SurfacePair& other) {
    witness_ = other.witness_;
    closed_witness_ = other.closed_witness_;
  }

  struct Answer {
    SeparationState state = SeparationState::kOpen;
    double clearance = 0.0;                ///< where apart: lower bound of the distance at the motion's end [m]
    std::optional<ContactPoint> crossing;  ///< where crossing
    bool is_near = false;  ///< where open: the surfaces come as near as all errors and twice the resolution
  };

  /// @param motion_error  the bodies are no farther than this from where the motion has them, both together [m].
  Answer decide(double motion_error, SeparationMemory& memory);

  /// When the surfaces first touch: apart before `enter`, and surely crossing at `exit`, which is infinite where no
  /// crossing is certain. `exit` is no later than `enter` by more than the surfaces take to go the resolution, but
  /// where they graze. Nothing if they are apart all along, as also of a body that is wholly inside the other [s].
  std::optional<Interval> firstTouch(double motion_error, SeparationMemory& memory);

  /// Whether neither body has a component wholly inside the other (design §3.15) at a pose at which the surfaces are
  /// apart. False also if that is not known.
  bool isOutside(const Isometry3d& X_FP) const;

  /// Whether it is doubtful what is outside of one of the bodies, or inside: then only surfaces tell, that are apart
  /// from what is outside, or that cross.
  bool isOutsideDoubtful() const { return field_->doubtful || shell_->doubtful; }
  bool isInsideDoubtful() const { return field_->inside_is_doubtful || shell_->inside_is_doubtful; }

 private:
  Answer decideBy(const BoxTree& a, const BoxTree& b, double margin, SeparationWitness& witness,
                  SeparationMemory& memory) const;
  void lookCloser(const BoxTree& f, const BoxTree& p, std::size_t step, SeparationOptions options,
                  SeparationWitness& witness, SeparationMemory& memory, Separation& found) const;
  ContactPoint contactAt(const Separation& found, std::size_t step) const;

  const Body *field_, *shell_;  // F, which the other moves against, and P
  bool f_is_a_;
  RelativeMotion motion_;
  double deviation_;
  double resolution_;
  SeparationWitness witness_, closed_witness_;
};

}  // namespace sdf_ccd
