#include "sdf_ccd/simulation.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "common/number_text.h"
#include "common/seconds_since.h"
#include "explicit_step.h"

namespace sdf_ccd {
namespace {

double reactionError(const Reaction& reaction) {
  const auto share = [](double error, double total) { return total > 0.0 ? error / total : 0.0; };
  return std::max(share(reaction.sum.force.norm(), reaction.impulses),
                  share(reaction.sum.torque.norm(), reaction.moments));
}

// Contacts are not searched beyond this distance [m].
constexpr double kFarthest = 1e11;
// Bound of energies and momenta, so that sums over all bodies stay finite.
constexpr double kLargest = 1e290;

/// @throws SimulationError for a body whose position, energy or momentum is out of range.
void requireComputable(const RigidWorld& world, const std::vector<BodyState>& states, long step) {
  for (std::size_t b = 0; b < states.size(); ++b) {
    const RigidBody& body = world.bodies[b];
    const Vector3d& position = states[b].X_OB.translation();
    if (!states[b].X_OB.matrix().allFinite()) {
      throw SimulationError(body.name, step, "its state is no longer finite; shorten the step or lower the stiffness");
    }
    if (!(position.cwiseAbs().maxCoeff() <= kFarthest)) {
      throw SimulationError(body.name, step, "it lies " + numberText(position.norm()) + " m from the scene's origin");
    }
    if (body.fixed) continue;
    const double energy = kineticEnergy(body, states[b]);
    const double momentum = body.mass * states[b].velocity.cwiseAbs().maxCoeff();
    const double force = (body.mass * world.gravity + body.applied.force).cwiseAbs().maxCoeff();
    if (!(energy <= kLargest) || !(kFarthest * momentum <= kLargest) || !(kFarthest * force <= kLargest)) {
      throw SimulationError(body.name, step, "its energy or momentum is beyond what can be computed");
    }
  }
}

}  // namespace

Simulation::Simulation(RigidWorld world, std::vector<BodyState> states, Scheme scheme, double step)
    : world_(std::make_unique<const RigidWorld>(std::move(world))),
      states_(std::move(states)),
      step_(step),
      report_(std::make_unique<StepReport>()) {
  if (!(step > 0.0) || !std::isfinite(step)) {
    throw std::invalid_argument("simulation: the time step must be finite and positive, got " + numberText(step));
  }
  validate(*world_, states_);
  integrator_ = makeIntegrator(scheme, *world_);
  requireComputable(*world_, states_, 0);
  measureContacts(*world_, states_, *report_);
  record_ = measured(states_, 0);
}

Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

const StepRecord& Simulation::advance() {
  const auto start = std::chrono::steady_clock::now();
  std::vector<BodyState> states = states_;
  const long step = record_.step + 1;
  integrator_->advance(step_, step, states, *report_);
  requireComputable(*world_, states, step);
  torque_work_ += workOfTorques(states_, states);
  record_ = measured(states, step);
  states_ = std::move(states);
  record_.run_time = secondsSince(start);
  return record_;
}

double Simulation::workOfTorques(const std::vector<BodyState>& before, const std::vector<BodyState>& after) const {
  double work = 0.0;
  for (std::size_t b = 0; b < after.size(); ++b) {
    const RigidBody& body = world_->bodies[b];
    if (!body.fixed) work += step_ * body.applied.torque.dot(before[b].X_OB.linear() * after[b].spin_B);
  }
  return work;
}

StepRecord Simulation::measured(const std::vector<BodyState>& states, long step) const {
  StepRecord record;
  record.step = step;
  record.time = double(step) * step_;
  record.potential = -torque_work_;
  std::size_t fastest = 0;
  double highest = -1.0;
  for (std::size_t b = 0; b < states.size(); ++b) {
    const RigidBody& body = world_->bodies[b];
    if (body.fixed) continue;
    const double kinetic = kineticEnergy(body, states[b]);
    record.kinetic += kinetic;
    record.potential -= (body.mass * world_->gravity + body.applied.force).dot(states[b].X_OB.translation());
    if (kinetic <= highest) continue;
    highest = kinetic;
    fastest = b;
  }
  record.elastic = report_->elastic_energy;
  record.momentum = totalMomentum(*world_, states);
  record.reaction_error = reactionError(report_->reaction);
  record.energy_excess = report_->energy_excess;
  record.deepest = report_->deepest;
  record.contacts = report_->contacts;
  record.solves = report_->solves;
  const bool finite = std::isfinite(record.energy() + record.reaction_error + record.energy_excess + record.deepest) &&
                      record.momentum.force.allFinite() && record.momentum.torque.allFinite();
  if (!finite) {
    throw SimulationError(world_->bodies[fastest].name, step,
                          "its contact is beyond what can be computed; shorten the step or lower the stiffness");
  }
  return record;
}

}  // namespace sdf_ccd
