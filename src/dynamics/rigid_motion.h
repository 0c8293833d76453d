#pragma once

#include <vector>

#include "sdf_ccd/dynamics/rigid_world.h"

namespace sdf_ccd {

/// Turns a body that nothing acts on by the implicit midpoint rule with Cayley's rotation, in substeps of at most a
/// tenth of a radian: energy and angular momentum (in O) stay what they are, to rounding, at any spin.
///
/// Source: Simo & Wong 1991, Int. J. Numer. Meth. Eng. 31, the conserving algorithm for SO(3).
/// A body whose spin needs no change (a ball, a spin about a principal axis) turns exactly.
void turnFreely(const Matrix3d& inertia_B, double duration, Matrix3d& R_OB, Vector3d& spin_B);

/// Where all bodies are during a step: at its start, its end, and between so often that no body turns farther than a
/// radian from one time to the next.
struct StepMotion {
  std::vector<double> times;                  ///< [s], from 0 to the step
  std::vector<std::vector<Isometry3d>> X_OB;  ///< per body, per time
};

/// All bodies at rest where they are, for `duration` [s].
void standStill(const std::vector<BodyState>& states, double duration, StepMotion& motion);

/// Moves all bodies for `duration` under no force. Reuses the memory of `motion`.
/// @param velocities  per body: how fast its origin moves [m/s]; state.velocity is not read and does not change.
/// @throws SimulationError (with `step`) for a body whose state is not finite, farther than 1e9 m from the scene's
/// origin, moves farther than that in the step, or turns farther than 1e4 rad in it.
void drift(const RigidWorld& world, const std::vector<Vector3d>& velocities, double duration, long step,
           std::vector<BodyState>& states, StepMotion& motion);

}  // namespace sdf_ccd
