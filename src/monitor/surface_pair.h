#pragma once

#include <optional>

#include "body/body_triangles.h"
#include "query/separation.h"
#include "sdf_ccd/monitor/monitor.h"
#include "swept_bodies.h"

namespace sdf_ccd {

/// Decides a pair by the triangles of both bodies, exactly but for what motions are known to (design §3.17): whether
/// their surfaces stay apart or surely cross.
class SurfacePair {
 public:
  /// If both bodies are all triangles.
  static bool isPossible(const Scene& scene, const PlannedPair& pair);
  SurfacePair(const Scene& scene, const PlannedPair& pair);

  /// Whether body A is F, which the other moves against.
  bool fieldIsA() const { return f_is_a_; }

  /// Takes the motion over a part of a cycle, of bodies that can be followed.
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span);

  /// No point of either body goes farther than this in the other's frame [m].
  double travel() const { return travel_; }

  /// What computing with the poses adds to the error of a distance [m].
  double poseError() const { return pose_error_; }

  /// What the triangles are off by from the surfaces [m].
  double deviation() const { return deviation_; }

  /// At both ends of the motion, of the smaller body in the larger one's frame.
  const Isometry3d& start() const { return X_FP_start_; }
  const Isometry3d& end() const { return X_FP_end_; }

  /// No point is farther from where it was at another pose than this, at the motion's start [m].
  double jumpFrom(const Isometry3d& X_FP) const;

  /// Of the ball around the smaller body: what is farther away than that need not be known well [m].
  double size() const { return shell_->ball.radius; }

  /// Lower bound of the surfaces' distance at a pose, by balls around them alone [m].
  double ballClearance(const Isometry3d& X_FP) const;

  /// Forgets where the last motion was looked at first: answers depend on what is asked alone then.
  void forget() { witness_ = closed_witness_ = {}; }

  struct Answer {
    SeparationState state = SeparationState::kOpen;
    double clearance = 0.0;                ///< where apart: lower bound of the distance at the motion's end [m]
    std::optional<ContactPoint> crossing;  ///< where crossing
  };

  /// @param motion_error  the bodies are no farther than this from where the motion has them, both together [m].
  Answer decide(double motion_error, SeparationMemory& memory);

  /// Whether neither body has a component wholly inside the other (design §3.15) at the motion's end, given that the
  /// surfaces are apart. False also if that is not known.
  bool isOutside() const;

 private:
  Answer decideBy(const BoxTree& a, const BoxTree& b, double margin, SeparationWitness& witness,
                  SeparationMemory& memory) const;
  ContactPoint contactAt(const Separation& found, std::size_t waypoint) const;

  const Body *field_, *shell_;  // F, which the other moves against, and P
  int f_, p_;
  bool f_is_a_;
  double deviation_;
  SeparationWitness witness_, closed_witness_;

  const SweptBodies* bodies_ = nullptr;
  WaypointSpan span_;
  Isometry3d X_FP_start_, X_FP_end_;
  double travel_ = 0.0, pose_error_ = 0.0;
};

}  // namespace sdf_ccd
