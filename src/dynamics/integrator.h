#pragma once

#include <memory>
#include <vector>

#include "sdf_ccd/simulation.h"

namespace sdf_ccd {

/// Contact impulses and moments on all bodies about O's origin, O's axes [N·s, N·m·s]: their sum, which is 0 up to the
/// rounding of the magnitudes.
struct Reaction {
  Wrench sum;
  double impulses = 0.0, moments = 0.0;  ///< sums of magnitudes, of a moment's parts too

  /// Adds an impulse whose moment is about `p_O`.
  void add(const Vector3d& p_O, const Wrench& impulse) {
    sum += {impulse.force, p_O.cross(impulse.force) + impulse.torque};
    impulses += impulse.force.norm();
    moments += p_O.norm() * impulse.force.norm() + impulse.torque.norm();
  }

  Reaction& operator+=(const Reaction& other) {
    sum += other.sum;
    impulses += other.impulses;
    moments += other.moments;
    return *this;
  }
};

/// Contacts and energies of a step.
struct StepReport {
  int contacts = 0;             ///< points inside a field at the step's end
  double deepest = 0.0;         ///< of them [m]
  double elastic_energy = 0.0;  ///< Σ ½ k φ² at the step's end [J]
  double energy_excess = 0.0;   ///< kImplicit: growth of energy that halving the step did not remove [J]
  int solves = 0;               ///< kImplicit: linear systems solved
  Reaction reaction;            ///< of the contacts during the step
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
