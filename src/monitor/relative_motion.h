#pragma once

#include <vector>

#include "motion/chords.h"
#include "swept_bodies.h"

namespace sdf_ccd {

/// Motion of body P relative to body F over a part of a cycle: one step per recorded interval, each with its bounds
/// (design §3.12).
class RelativeMotion {
 public:
  RelativeMotion(const Scene& scene, int f, int p);

  int f() const { return f_; }
  int p() const { return p_; }

  /// Sets the motion; SweptBodies::problem() must be empty for both bodies.
  /// @param bounds  receives the bounds of each step; no one else may use it as long as this motion is in use.
  void take(const SweptBodies& bodies, const WaypointSpan& span, std::vector<RelativeMotionBounds>& bounds);

  /// Step k lasts from recorded time k of the span to the next; k = 0 is the first.
  std::size_t steps() const { return bounds_->size(); }
  const RelativeMotionBounds& bounds(std::size_t step) const { return (*bounds_)[step]; }
  TwoBodyMotion motion(std::size_t step) const;

  /// X_FP at the first and last time.
  const Isometry3d& start() const { return X_FP_start_; }
  const Isometry3d& end() const { return X_FP_end_; }

  /// Upper bound of the displacement of P's ball's points in F [m].
  double travel() const { return travel_; }

  /// Upper bound of the distance of P's ball's points from F's origin, at any time [m].
  double reach() const;

  /// Error that the rounding of the poses adds to a distance [m].
  double poseError() const { return pose_error_; }

  /// Factor from the motion error of F, which holds within its ball, to the error of its surface where P is. It exceeds
  /// 1 for a half-space, which reaches beyond its ball: motion errors grow at most in proportion to the distance.
  double errorScaleOfF() const;

  /// Upper bound of the displacement of P's ball's points from another pose to start() [m].
  double jumpFrom(const Isometry3d& X_FP) const { return maxDisplacement(X_FP, X_FP_start_, *ball_); }

 private:
  const BoundingBall* ball_;  // of P
  bool is_f_in_ball_;
  int f_, p_;
  const SweptBodies* bodies_ = nullptr;
  WaypointSpan span_;
  const std::vector<RelativeMotionBounds>* bounds_ = nullptr;
  Isometry3d X_FP_start_, X_FP_end_;
  double travel_ = 0.0;
  double pose_error_ = 0.0;
};

}  // namespace sdf_ccd
