#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/rigid_body.h"
#include "sdf_ccd/contact/penalty.h"

namespace sdf_ccd {

/// Rigid bodies and what acts on them. The scene's frame O has the world's axes and lies among the bodies, so that
/// contact far from the world's origin is as exact as at it.
struct RigidWorld {
  std::vector<RigidBody> bodies;
  Vector3d origin_W = Vector3d::Zero();          ///< of O [m]
  Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< [m/s²]
  ContactOptions contact;
  double chord_tolerance = 1e-3;  ///< deviation of a point's arc from its chords, as a share of its body's radius
};

/// A simulation cannot go on: which body, at which step, why.
class SimulationError : public std::runtime_error {
 public:
  SimulationError(const std::string& body, long step, const std::string& reason)
      : std::runtime_error("body `" + body + "`, step " + std::to_string(step) + ": " + reason) {}
};

/// Throws SimulationError (step 0) that names the first body that cannot be simulated, or std::invalid_argument for
/// options that are not valid: a mass, inertia, force or state that is not finite or not positive, a body without
/// field and shell, a moving half-space, fields deeper than they know.
void validate(const RigidWorld& world, const std::vector<BodyState>& states);

/// ½ m v² + ½ ω·Iω [J]; 0 for a fixed body.
double kineticEnergy(const RigidBody& body, const BodyState& state);

/// Momentum [N·s] and angular momentum about O's origin [N·m·s] of all bodies that move.
Wrench totalMomentum(const RigidWorld& world, const std::vector<BodyState>& states);

}  // namespace sdf_ccd
