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

/// A function and its derivatives, or what bounds them.
struct DerivativeSeries {
  double value = 0.0, first = 0.0, second = 0.0, third = 0.0;

  /// Of the product, by Leibniz' rule.
  DerivativeSeries operator*(const DerivativeSeries& other) const;
  DerivativeSeries operator+(const DerivativeSeries& other) const;
};

/// Bounds how the points of a body can move while the frames that carry it turn and slide, from rates and reaches alone
/// (Schwarzer, Saha, Latombe 2005; here up to third derivatives): joints of a robot along a trajectory, or the frames
/// of tf2, which turns (slerp) and slides each of them evenly between two transforms.
///
/// Begin with the body's ball and add the frames from the body up to the one that points are seen from.
class ChainDerivatives {
 public:
  /// @param ball  holds the points; in the frame that is added first.
  explicit ChainDerivatives(const BoundingBall& ball) : series_{ball.center.norm() + ball.radius} {}

  /// A frame that moves in its parent: x ↦ t(s) + R(s) x, R about an axis that does not turn.
  /// @param reach  |t(s)| is nowhere more [m].
  /// @param angle, slide  of R and of t.
  void addFrame(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide);

  /// The same passed the other way, from the parent to the frame: x ↦ R(s)ᵀ (x − t(s)).
  void addInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide);

  double distance() const { return series_.value; }  ///< of any point from the last frame's origin [m]
  double speed() const { return series_.first; }     ///< [m], as the following
  double acceleration() const { return series_.second; }
  double jerk() const { return series_.third; }

 private:
  DerivativeSeries series_;
};

/// The same bounds the other way round: from the frame that points are seen from down to those that carry them, so that
/// a tree of frames is gone through once for all bodies. What a chain of frames makes of the series D of a point, its
/// distance from the last frame's origin first, is A D + B.
class CarriedDerivatives {
 public:
  /// Of a further frame that moves in the last one, as ChainDerivatives::addFrame().
  CarriedDerivatives carrying(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) const;

  /// Of a further frame in which the last one moves, as ChainDerivatives::addInverse().
  CarriedDerivatives carryingInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) const;

  /// Of points that rest in the last frame, no farther from its origin [m].
  DerivativeSeries of(double distance) const { return turn_ * DerivativeSeries{distance} + shift_; }

 private:
  DerivativeSeries turn_{1.0}, shift_;  // A, B
};

}  // namespace sdf_ccd
