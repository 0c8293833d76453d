#pragma once

#include "sdf_ccd/motion/screw_motion.h"

namespace sdf_ccd {

/// Bounds of the derivatives of a length [m] or an angle [rad] by s, while s runs from 0 to 1. What moves evenly has a
/// first derivative alone: all that it moves by.
struct DerivativeBounds {
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;
};

/// Bounds how the points of a body can move while the frames that carry it turn and slide, from rates and reaches alone
/// (Schwarzer, Saha, Latombe 2005; here up to third derivatives): joints of a robot along a trajectory, or the frames
/// of tf2, which turns (slerp) and slides each of them evenly between two transforms.
///
/// Begin with the body's ball and add the frames from the body up to the one that points are seen from.
class ChainDerivatives {
 public:
  /// @param ball  holds the points; in the frame that is added first.
  explicit ChainDerivatives(const BoundingBall& ball) : distance_(ball.center.norm() + ball.radius) {}

  /// A frame that moves in its parent: x ↦ t(s) + R(s) x, R about an axis that does not turn.
  /// @param reach  |t(s)| is nowhere more [m].
  /// @param angle, slide  of R and of t.
  void addFrame(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide);

  /// The same passed the other way, from the parent to the frame: x ↦ R(s)ᵀ (x − t(s)).
  void addInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide);

  double distance() const { return distance_; }  ///< of any point from the last frame's origin [m]
  double speed() const { return first_; }        ///< [m], as the following
  double acceleration() const { return second_; }
  double jerk() const { return third_; }

 private:
  void slideBy(double reach, const DerivativeBounds& slide);
  void turnBy(const DerivativeBounds& angle);

  double distance_;
  double first_ = 0.0, second_ = 0.0, third_ = 0.0;
};

}  // namespace sdf_ccd
