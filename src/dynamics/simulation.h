#pragma once

#include <memory>
#include <vector>

#include "dynamics/integrator.h"

namespace sdf_ccd {

/// A step, measured at its end: what was between two ends, such as a deeper point, is not in it.
struct StepRecord {
  long step = 0;
  double time = 0.0;            ///< [s]
  double kinetic = 0.0;         ///< [J]
  double potential = 0.0;       ///< of gravity and applied forces, about O's origin, less what applied torques did [J]
  double elastic = 0.0;         ///< of contact [J]
  Wrench momentum;              ///< of all moving bodies, about O's origin [N·s, N·m·s]
  double reaction_error = 0.0;  ///< |Σ contact impulses and moments over all bodies| / Σ |…|; 0 up to rounding
  double energy_excess = 0.0;   ///< see StepReport [J]
  double deepest = 0.0;         ///< contact point [m]
  int contacts = 0;             ///< points inside a field
  int solves = 0;               ///< linear systems solved, see StepReport
  double run_time = 0.0;        ///< [s]

  double energy() const { return kinetic + potential + elastic; }
};

/// Steps a world. Nothing that it returns is ever not a number: what cannot be computed is a SimulationError.
class Simulation {
 public:
  /// @param step  [s].
  /// @throws SimulationError, std::invalid_argument as validate() does; also for a step that is not finite or positive,
  /// and for a body whose place, energy or momentum is beyond what can be computed.
  Simulation(RigidWorld world, std::vector<BodyState> states, Scheme scheme, double step);

  /// @throws SimulationError if a body's state leaves what can be computed; states() and last() then stay as they were.
  const StepRecord& advance();

  const RigidWorld& world() const { return *world_; }
  const std::vector<BodyState>& states() const { return states_; }
  const StepRecord& last() const { return record_; }

 private:
  StepRecord measured(const std::vector<BodyState>& states, long step) const;
  double workOfTorques(const std::vector<BodyState>& before, const std::vector<BodyState>& after) const;

  std::unique_ptr<const RigidWorld> world_;  // the integrator holds on to it
  std::vector<BodyState> states_;
  std::unique_ptr<Integrator> integrator_;
  double step_;
  double torque_work_ = 0.0;  // so far [J]
  StepReport report_;
  StepRecord record_;
};

}  // namespace sdf_ccd
