#include "sdf_ccd/simulation.h"

#include <cmath>

#include "common/number_text.h"
#include "dynamics/collision_shape.h"

namespace sdf_ccd {
namespace {

void validateBody(const RigidBody& body, const BodyState& state) {
  if (!body.shape) throw std::invalid_argument("has no shape");
  const CollisionShape& shape = *body.shape;
  if (!shape.field && shape.shell.size() == 0) throw std::invalid_argument("has neither a field nor shell points");
  const Matrix3d R = state.X_OB.linear();
  if (!state.X_OB.matrix().allFinite()) throw std::invalid_argument("its pose is not finite");
  if (!(R.transpose() * R).isIdentity(1e-9)) throw std::invalid_argument("its rotation is not orthonormal");
  if (!state.velocity.allFinite() || !state.spin_B.allFinite()) {
    throw std::invalid_argument("its velocity is not finite");
  }
  if (body.fixed) return;
  if (shape.field && !shape.field->surfaceBox().sizes().allFinite()) {
    throw std::invalid_argument("a half-space cannot move; make it fixed");
  }
  validateInertia(body.mass, body.inertia);
  if (!body.applied.force.allFinite() || !body.applied.torque.allFinite()) {
    throw std::invalid_argument("its applied force is not finite");
  }
}

}  // namespace

void validate(const RigidWorld& world, const std::vector<BodyState>& states) {
  validate(world.contact);
  if (!world.gravity.allFinite()) throw std::invalid_argument("gravity is not finite");
  if (!world.origin_W.allFinite()) throw std::invalid_argument("the scene's origin is not finite");
  if (!(world.chord_tolerance > 0.0) || !std::isfinite(world.chord_tolerance)) {
    throw std::invalid_argument("chord tolerance must be finite and positive, got " +
                                numberText(world.chord_tolerance));
  }
  if (states.size() != world.bodies.size()) {
    throw std::invalid_argument(std::to_string(world.bodies.size()) + " bodies, " + std::to_string(states.size()) +
                                " states");
  }
  for (std::size_t b = 0; b < states.size(); ++b) {
    try {
      validateBody(world.bodies[b], states[b]);
    } catch (const std::invalid_argument& error) {
      throw SimulationError(world.bodies[b].name, 0, error.what());
    }
  }
}

double kineticEnergy(const RigidBody& body, const BodyState& state) {
  if (body.fixed) return 0.0;
  return 0.5 * body.mass * state.velocity.squaredNorm() + 0.5 * state.spin_B.dot(body.inertia * state.spin_B);
}

Wrench totalMomentum(const RigidWorld& world, const std::vector<BodyState>& states) {
  Wrench total;
  for (std::size_t b = 0; b < states.size(); ++b) {
    const RigidBody& body = world.bodies[b];
    if (body.fixed) continue;
    const Vector3d momentum = body.mass * states[b].velocity;
    const Vector3d spin = states[b].X_OB.linear() * (body.inertia * states[b].spin_B);
    total += {momentum, states[b].X_OB.translation().cross(momentum) + spin};
  }
  return total;
}

}  // namespace sdf_ccd
