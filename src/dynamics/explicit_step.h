#pragma once

#include "dynamics/integrator.h"
#include "end_contacts.h"

namespace sdf_ccd {

/// Changes velocities by gravity, applied forces and contact impulses (per body, about its origin, O's axes).
void kick(const RigidWorld& world, const std::vector<Wrench>& contact, double duration, std::vector<BodyState>& states);

/// Adds an impulse on the shell's body about its origin, and the opposite on the field's: action equals reaction for
/// forces, and for moments about any common point.
/// @param p_FP  from the field's body's origin to the shell's body's [m], O's axes.
void addPair(const Wrench& on_shell, const Vector3d& p_FP, Wrench& shell_total, Wrench& field_total);

/// Of impulses about the bodies' origins, for the report.
Reaction reactionOf(const std::vector<Wrench>& impulses, const std::vector<BodyState>& states);

/// Fills in the measurements at the end of a step.
void measure(const std::vector<PairContacts>& contacts, StepReport& report);

/// The same for bodies at rest in `states`.
void measureContacts(const RigidWorld& world, const std::vector<BodyState>& states, StepReport& report);

std::unique_ptr<Integrator> makeContinuousIntegrator(const RigidWorld& world);
std::unique_ptr<Integrator> makeDiscreteIntegrator(const RigidWorld& world);
std::unique_ptr<Integrator> makeImplicitIntegrator(const RigidWorld& world);

}  // namespace sdf_ccd
