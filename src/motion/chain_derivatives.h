#pragma once

#include "screw_motion.h"

namespace sdf_ccd {

/// Bounds of the derivatives of a length [m] or an angle [rad] by s, while s runs from 0 to 1. A uniform motion has a
/// first derivative alone: its whole displacement.
struct DerivativeBounds {
  double first = 0.0;
  double second = 0.0;
  double third = 0.0;
};

/// A function and its derivatives, or bounds of them.
struct DerivativeSeries {
  double value = 0.0, first = 0.0, second = 0.0, third = 0.0;

  /// Of the product, by Leibniz' rule.
  DerivativeSeries operator*(const DerivativeSeries& other) const;
  DerivativeSeries operator+(const DerivativeSeries& other) const;
};

/// Bounds the motion of a body's points while the frames that carry it rotate and translate, by rates and reaches alone
/// (Schwarzer, Saha, Latombe 2005; here up to third derivatives): joints of a robot along a trajectory, or the frames
/// of tf2, which interpolates rotations (slerp) and translations of each of them linearly between two transforms.
///
/// Begin with the body's ball and add the frames from the body up to the frame of reference.
class ChainDerivatives {
 public:
  /// @param ball  contains the points; in the frame that is added first.
  explicit ChainDerivatives(const BoundingBall& ball) : series_{ball.center.norm() + ball.radius} {}

  /// A frame that moves in its parent: x ↦ t(s) + R(s) x, R about a constant axis.
  /// @param reach  upper bound of |t(s)| [m].
  /// @param angle, slide  of R and of t.
  void addFrame(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide);

  /// The inverse transform, from the parent to the frame: x ↦ R(s)ᵀ (x − t(s)).
  void addInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide);

  double distance() const { return series_.value; }  ///< of any point from the last frame's origin [m]
  double speed() const { return series_.first; }     ///< [m], as the following
  double acceleration() const { return series_.second; }
  double jerk() const { return series_.third; }

 private:
  DerivativeSeries series_;
};

/// The same bounds in the opposite order: from the frame of reference down to the frames that carry the points, so that
/// a tree of frames is traversed once for all bodies. A chain of frames maps the series D of a point, whose value is
/// its distance from the last frame's origin, to A D + B.
class CarriedDerivatives {
 public:
  /// The chain with a further frame that moves in the last one, as ChainDerivatives::addFrame().
  CarriedDerivatives carrying(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) const;

  /// The chain with a further frame in which the last one moves, as ChainDerivatives::addInverse().
  CarriedDerivatives carryingInverse(double reach, const DerivativeBounds& angle, const DerivativeBounds& slide) const;

  /// For points at rest in the last frame, at most this far from its origin [m].
  DerivativeSeries of(double distance) const { return turn_ * DerivativeSeries{distance} + shift_; }

 private:
  DerivativeSeries turn_{1.0}, shift_;  // A, B
};

}  // namespace sdf_ccd
