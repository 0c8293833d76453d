#pragma once

#include <memory>
#include <vector>

#include "sdf_ccd/dynamics/simulation.h"

namespace sdf_ccd {

/// Contacts and energies of a step.
struct StepReport {
  int contacts = 0;              ///< points inside a field at the step's end
  double deepest = 0.0;          ///< of them [m]
  double elastic_energy = 0.0;   ///< Σ ½ k φ² at the step's end [J]
  double energy_excess = 0.0;    ///< kImplicit: growth of energy that halving the step did not remove [J]
  int solves = 0;                ///< kImplicit: linear systems solved
  std::vector<Wrench> impulses;  ///< of contact, per body, about O's origin [N·s, N·m·s], O's axes
};

/// Advances bodies in time under gravity, applied forces and contact. Keeps the data of the last step that it needs.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// @param duration  of the step [s]; finite and positive.
  /// @param step      number of the step, for errors.
  /// @throws SimulationError if a body's state is out of range.
  virtual void advance(double duration, long step, std::vector<BodyState>& states, StepReport& report) = 0;
};

/// @param world  must outlive the integrator, and its bodies and shapes must not change.
/// @throws std::invalid_argument for kImplicit with shell normals.
std::unique_ptr<Integrator> makeIntegrator(Scheme scheme, const RigidWorld& world);

}  // namespace sdf_ccd
