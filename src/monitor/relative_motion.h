#pragma once

#include <vector>

#include "sdf_ccd/motion/chords.h"
#include "swept_bodies.h"

namespace sdf_ccd {

/// How body P moves against body F over a part of a cycle: step by step, each with its bounds (design §3.12).
class RelativeMotion {
 public:
  RelativeMotion(const Scene& scene, int f, int p) : ball_(&scene.bodies[p].ball), f_(f), p_(p) {}

  int f() const { return f_; }
  int p() const { return p_; }

  /// Takes the motion of bodies that can be followed.
  /// @param bounds  gets those of each step; this motion's alone as long as it is used.
  void take(const SweptBodies& bodies, const WaypointSpan& span, std::vector<RelativeMotionBounds>& bounds);

  /// From one recorded time to the next, the span's first at 0.
  std::size_t steps() const { return bounds_->size(); }
  const RelativeMotionBounds& bounds(std::size_t step) const { return (*bounds_)[step]; }
  TwoBodyMotion motion(std::size_t step) const;

  /// X_FP at both ends.
  const Isometry3d& start() const { return X_FP_start_; }
  const Isometry3d& end() const { return X_FP_end_; }

  /// No point of P's ball goes farther than this in F [m].
  double travel() const { return travel_; }

  /// Nor is it ever farther from F's origin [m].
  double reach() const;

  /// What computing with the poses adds to the error of a distance [m].
  double poseError() const { return pose_error_; }

  /// No point of P's ball is farther from where it was at another pose than this, at the start [m].
  double jumpFrom(const Isometry3d& X_FP) const { return maxDisplacement(X_FP, X_FP_start_, *ball_); }

 private:
  const BoundingBall* ball_;  // of P
  int f_, p_;
  const SweptBodies* bodies_ = nullptr;
  WaypointSpan span_;
  const std::vector<RelativeMotionBounds>* bounds_ = nullptr;
  Isometry3d X_FP_start_, X_FP_end_;
  double travel_ = 0.0;
  double pose_error_ = 0.0;
};

}  // namespace sdf_ccd
