#pragma once

#include <array>

#include "common/compiler_lanes.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A body's step between two poses in the world.
struct BodyStep {
  const Isometry3d* start;
  const Isometry3d* end;
  const BoundingBall* ball;  ///< in the body's frame
};

/// The motions of several bodies over a step, a body a lane: each as a constant twist about a reference point.
struct TwistLanes {
  static constexpr std::size_t kCount = lanes::kWidth;
  static constexpr double kTrace = 2.9845;  ///< 1 + 2 cos(1/8), rounded up: the trace of a rotation by 1/8 rad
  using Lane = std::array<double, kCount>;
  using Vector = std::array<Lane, 3>;

  Vector center_W;   ///< of the ball, at the end [m]
  Lane defect;       ///< upper bound of |RᵀR − 1| of the end's rotation R, without rounding
  Lane trace;        ///< of the rotation in the step. If it is not above kTrace, the values below are not valid
  Vector omega;      ///< rotation vector in world axes [rad]
  Lane turn;         ///< its amount [rad]
  Vector velocity;   ///< of the reference point, per step [m]
  Vector point_W;    ///< the reference point: the middle between the ball's centres at the start and the end [m]
  Lane shift;        ///< displacement of the ball's centre, no less than the velocity's amount [m]
  Lane coordinates;  ///< sum of the coordinates' amounts of both translations and of the ball's centre [m]

  static Vector3d at(const Vector& vector, std::size_t lane) {
    return {vector[0][lane], vector[1][lane], vector[2][lane]};
  }
};

/// By series, for rotations by θ < 1/8, so that sin²θ < 0.0156.
///
/// Let θ = |ω| and Δ the displacement of the ball's centre, with parts Δ_∥ along the axis and Δ_⊥ across it.
/// The centre moves on an arc of radius ρ and angle θ with the chord |Δ_⊥| = 2 ρ sin(θ/2). The chord's middle m
/// is ρ cos(θ/2) from the axis, so its velocity is Δ_∥ + (θ/2) cot(θ/2) Δ_⊥.
///
/// θ / sin θ = asin(s)/s = 1 + s²/6 + 3 s⁴/40 + 5 s⁶/112 + …; the relative error of truncation is below 2e-9.
/// (θ/2) cot(θ/2) = 1 − θ²/12 − θ⁴/720 − …; the truncated terms are below 4e-7 of Δ_⊥, and θ² Δ_⊥ = −ω × (ω × Δ).
/// So the velocity's amount is at most |Δ|.
void computeTwists(const std::array<BodyStep, TwistLanes::kCount>& steps, TwistLanes& twists);

}  // namespace sdf_ccd
