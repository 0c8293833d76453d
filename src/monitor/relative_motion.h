#pragma once

#include <vector>

#include "motion/chords.h"
#include "swept_bodies.h"

namespace sdf_ccd {

/// The motion of a pair's bodies over a part of a cycle.
struct PairMotion {
  const SweptBodies& bodies;  ///< SweptBodies::problem() must be empty for both
  int body_a, body_b;         ///< in the scene of `bodies`
  WaypointSpan span;
};

/// Motion of body P relative to body F over a part of a cycle: one step per recorded interval, each with its bounds
/// (design §3.12).
class RelativeMotion {
 public:
  /// @param f_is_a  body F is body A of its pair, otherwise body P is.
  RelativeMotion(const Body& f, const Body& p, bool f_is_a);

  bool fIsA() const { return f_is_a_; }

  /// Sets the motion.
  /// @param bounds  receives the bounds of each step; no one else may use it as long as this motion is in use.
  void set(const PairMotion& pair, std::vector<RelativeMotionBounds>& bounds);

  /// Step k lasts from recorded time k of the span to the next; k = 0 is the first.
  std::size_t steps() const { return bounds_->size(); }
  const RelativeMotionBounds& bounds(std::size_t step) const { return (*bounds_)[step]; }
  TwoBodyMotion motion(std::size_t step) const;

  /// Its first and last time [s].
  double startTime() const { return motion(0).t_start; }
  double endTime() const { return motion(steps() - 1).t_end; }

  /// A time within a step.
  struct StepTime {
    std::size_t step;
    double s;  ///< from 0 to 1
  };
  StepTime stepAt(double time) const;

  /// X_FP at the first and last time.
  const Isometry3d& start() const { return X_FP_start_; }
  const Isometry3d& end() const { return X_FP_end_; }

  /// Upper bound of the displacement of P's ball's points in F [m].
  double travel() const { return travel_; }

  /// Upper bound of the distance of P's ball's points from F's origin, at any time [m].
  double reach() const;

  /// Error that the rounding of the poses adds to a distance [m].
  double poseError() const { return pose_error_; }

  /// The motion error given with a cycle's motion, for both bodies together [m]. @param pair  of these bodies.
  double givenError(const CycleMotion& motion, const PairResult& pair) const;

  /// Upper bound of the displacement of P's ball's points from another pose to start() [m].
  double jumpFrom(const Isometry3d& X_FP) const { return maxDisplacement(X_FP, X_FP_start_, *ball_); }

 private:
  /// Factor from the motion error of F, which holds within its ball, to the error of its surface where P is. It exceeds
  /// 1 for a half-space, which reaches beyond its ball: motion errors grow at most in proportion to the distance.
  double errorScaleOfF() const;

  const BoundingBall* ball_;  // of P
  bool is_f_in_ball_;
  bool f_is_a_;
  int f_ = -1, p_ = -1;  // in the scene of bodies_
  const SweptBodies* bodies_ = nullptr;
  WaypointSpan span_;
  const std::vector<RelativeMotionBounds>* bounds_ = nullptr;
  Isometry3d X_FP_start_, X_FP_end_;
  double travel_ = 0.0;
  double pose_error_ = 0.0;
};

}  // namespace sdf_ccd
