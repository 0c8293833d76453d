#include "explicit_step.h"

#include <algorithm>
#include <stdexcept>

namespace sdf_ccd {

void kick(const RigidWorld& world, const std::vector<Wrench>& contact, double duration,
          std::vector<BodyState>& states) {
  for (std::size_t b = 0; b < states.size(); ++b) {
    const RigidBody& body = world.bodies[b];
    if (body.fixed) continue;
    const Vector3d impulse = contact[b].force + duration * body.applied.force;
    const Vector3d moment = contact[b].torque + duration * body.applied.torque;
    states[b].velocity += duration * world.gravity + impulse / body.mass;
    states[b].spin_B += body.inertia.ldlt().solve(states[b].X_OB.linear().transpose() * moment);
  }
}

void addPair(const Wrench& on_shell, const Vector3d& p_FP, Wrench& shell_total, Wrench& field_total) {
  shell_total += on_shell;
  field_total += {-on_shell.force, -on_shell.torque - p_FP.cross(on_shell.force)};
}

Reaction reactionOf(const std::vector<Wrench>& impulses, const std::vector<BodyState>& states) {
  Reaction reaction;
  for (std::size_t b = 0; b < states.size(); ++b) reaction.add(states[b].X_OB.translation(), impulses[b]);
  return reaction;
}

void measure(const std::vector<PairContacts>& contacts, StepReport& report) {
  report.contacts = 0;
  report.deepest = 0.0;
  for (const PairContacts& pair : contacts) {
    for (const PointContact& point : pair.points) {
      report.contacts += point.depth < 0.0;
      report.deepest = std::max(report.deepest, -point.depth);
    }
  }
  report.elastic_energy = elasticEnergy(contacts);
}

void measureContacts(const RigidWorld& world, const std::vector<BodyState>& states, StepReport& report) {
  ContactSearch search(world);
  std::vector<PairContacts> contacts;
  contactsAtRest(world, states, search, contacts);
  measure(contacts, report);
}

const char* toString(Scheme scheme) {
  switch (scheme) {
    case Scheme::kContinuous:
      return "continuous";
    case Scheme::kDiscrete:
      return "discrete";
    case Scheme::kImplicit:
      return "implicit";
  }
  return "";
}

Scheme schemeOf(const std::string& name) {
  for (const Scheme scheme : {Scheme::kContinuous, Scheme::kDiscrete, Scheme::kImplicit}) {
    if (name == toString(scheme)) return scheme;
  }
  throw std::invalid_argument("integrator `" + name + "`: expected continuous, discrete or implicit");
}

std::unique_ptr<Integrator> makeIntegrator(Scheme scheme, const RigidWorld& world) {
  switch (scheme) {
    case Scheme::kContinuous:
      return makeContinuousIntegrator(world);
    case Scheme::kDiscrete:
      return makeDiscreteIntegrator(world);
    case Scheme::kImplicit:
      return makeImplicitIntegrator(world);
  }
  throw std::invalid_argument("no such integrator");
}

}  // namespace sdf_ccd
