#pragma once

#include <memory>
#include <string>
#include <vector>

#include "dynamics/rigid_world.h"

namespace sdf_ccd {

/// How contact enters a time step.
enum class Scheme {
  /// The paper's §4: symplectic Euler under the force and torque averaged over the last step's continuous contact
  /// (Eq. 8-11). A persistent contact (s = ωΔt, damping ratio ζ) is stable only for s/4 < ζ < 1/s (design §3.10).
  kContinuous,
  /// What the paper compares with: symplectic Euler under penalty and damping forces at the sampled pose; stable for
  /// s² + 4ζs < 4.
  kDiscrete,
  /// Ours: backward Euler by Newton's method on the 6×6 stiffness and damping blocks of all contact points, contacts
  /// found continuously. A persistent contact is stable at any step. A step whose energy would grow is halved. It
  /// costs accuracy: at ζ = 0 a contact oscillation is damped as by ζ ≈ s/2, so impacts that last few steps lose most
  /// of their energy. Needs field normals.
  kImplicit
};

const char* toString(Scheme scheme);

/// @throws std::invalid_argument for any other name.
Scheme schemeOf(const std::string& name);

/// What happened in a step.
struct StepReport {
  int contacts = 0;              ///< points inside a field at the step's end
  double deepest = 0.0;          ///< of them [m]
  double elastic_energy = 0.0;   ///< Σ ½ k φ² at the step's end [J]
  double energy_excess = 0.0;    ///< kImplicit: growth of energy that halving the step did not remove [J]
  int solves = 0;                ///< kImplicit: linear systems solved
  std::vector<Wrench> impulses;  ///< of contact, per body, about O's origin [N·s, N·m·s], O's axes
};

/// Advances bodies in time under gravity, applied forces and contact. Remembers what its scheme needs of the last step.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// @param duration  of the step [s]; finite and positive.
  /// @param step      number of the step, for errors.
  /// @throws SimulationError if a body's state leaves what can be computed.
  virtual void advance(double duration, long step, std::vector<BodyState>& states, StepReport& report) = 0;
};

/// @param world  must outlive the integrator, and its bodies and shapes must not change.
/// @throws std::invalid_argument for kImplicit with shell normals.
std::unique_ptr<Integrator> makeIntegrator(Scheme scheme, const RigidWorld& world);

}  // namespace sdf_ccd
