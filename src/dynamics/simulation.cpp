#include "sdf_ccd/dynamics/simulation.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "explicit_step.h"
#include "sdf_ccd/geometry/number_text.h"

namespace sdf_ccd {
namespace {

double reactionError(const std::vector<Wrench>& impulses) {
  Wrench sum;
  double forces = 0.0, torques = 0.0;
  for (const Wrench& impulse : impulses) {
    sum += impulse;
    forces += impulse.force.norm();
    torques += impulse.torque.norm();
  }
  const auto share = [](double error, double total) { return total > 0.0 ? error / total : 0.0; };
  return std::max(share(sum.force.norm(), forces), share(sum.torque.norm(), torques));
}

}  // namespace

Simulation::Simulation(RigidWorld world, std::vector<BodyState> states, Scheme scheme, double step)
    : world_(std::make_unique<const RigidWorld>(std::move(world))), states_(std::move(states)), step_(step) {
  if (!(step > 0.0) || !std::isfinite(step)) {
    throw std::invalid_argument("simulation: the time step must be finite and positive, got " + numberText(step));
  }
  validate(*world_, states_);
  integrator_ = makeIntegrator(scheme, *world_);
  measureContacts(*world_, states_, report_);
  measure();
}

const StepRecord& Simulation::advance() {
  const auto start = std::chrono::steady_clock::now();
  std::vector<BodyState> states = states_;
  integrator_->advance(step_, record_.step + 1, states, report_);
  for (std::size_t b = 0; b < states.size(); ++b) {
    const double energy = kineticEnergy(world_->bodies[b], states[b]);
    if (!states[b].X_OB.matrix().allFinite() || !std::isfinite(energy) || !std::isfinite(report_.elastic_energy)) {
      throw SimulationError(world_->bodies[b].name, record_.step + 1,
                            "its state is no longer finite; shorten the step or lower the stiffness");
    }
  }
  torque_work_ += workOfTorques(states_, states);
  states_ = std::move(states);
  ++record_.step;
  measure();
  record_.run_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

void Simulation::measure() {
  record_.time = double(record_.step) * step_;
  record_.kinetic = 0.0;
  record_.potential = -torque_work_;
  for (std::size_t b = 0; b < states_.size(); ++b) {
    const RigidBody& body = world_->bodies[b];
    if (body.fixed) continue;
    record_.kinetic += kineticEnergy(body, states_[b]);
    record_.potential -= (body.mass * world_->gravity + body.applied.force).dot(states_[b].X_OB.translation());
  }
  record_.elastic = report_.elastic_energy;
  record_.momentum = totalMomentum(*world_, states_);
  record_.reaction_error = reactionError(report_.impulses);
  record_.energy_excess = report_.energy_excess;
  record_.deepest = report_.deepest;
  record_.contacts = report_.contacts;
  record_.solves = report_.solves;
}

}  // namespace sdf_ccd
