#pragma once

#include <vector>

#include "sdf_ccd/simulation.h"

namespace sdf_ccd {

/// Bodies may be no farther from the scene's origin than this, and move no farther in one step [m].
constexpr double kMaxDistance = 1e9;

/// Rotates a body without forces by the implicit midpoint rule with Cayley's rotation: energy and angular momentum (in
/// O) are conserved, to rounding, at any spin. The rule's step is lengthened until each midpoint spin rotates the body
/// by its own angle, so a constant spin (of a sphere, about a principal axis) is exact, and one near it nearly so.
/// Substeps of at most 0.2 rad, each of five steps in Suzuki's proportions, are of fourth order: tops of several
/// shapes are within 5e-5 rad of the truth after 100 rad.
///
/// Source: Simo & Wong 1991, Int. J. Numer. Meth. Eng. 31, the conserving algorithm for SO(3); Suzuki 1990, Phys. Lett.
/// A 146, the proportions.
void rotateFreely(const Matrix3d& inertia_B, double duration, Matrix3d& R_OB, Vector3d& spin_B);

/// Poses of all bodies during a step: at its start, its end, and at times between so that no body rotates by more than
/// a radian from one time to the next. Between two times their origins move straight, and they rotate at constant
/// rates.
struct StepMotion {
  std::vector<double> times;                  ///< [s], from 0 to the step
  std::vector<std::vector<Isometry3d>> X_OB;  ///< per body, per time
};

/// All bodies at rest in their poses, for `duration` [s].
void restMotion(const std::vector<BodyState>& states, double duration, StepMotion& motion);

/// Whether a motion ends in these poses.
bool endsAt(const StepMotion& motion, const std::vector<BodyState>& states);

/// Moves all bodies for `duration` under no force. Reuses the memory of `motion`.
/// @param velocities  per body: of its origin [m/s]; state.velocity is neither read nor changed.
/// @throws SimulationError (with `step`) for a body whose state is not finite, farther than kMaxDistance from the
/// scene's origin, moves farther than that in the step, or rotates by more than 1e4 rad in it.
void drift(const RigidWorld& world, const std::vector<Vector3d>& velocities, double duration, long step,
           std::vector<BodyState>& states, StepMotion& motion);

}  // namespace sdf_ccd
