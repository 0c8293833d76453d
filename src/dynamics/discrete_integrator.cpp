#include "explicit_step.h"

namespace sdf_ccd {
namespace {

/// Symplectic Euler under the contact forces at the sampled pose: the scheme that the paper's Figure 6 compares with.
class DiscreteIntegrator : public Integrator {
 public:
  explicit DiscreteIntegrator(const RigidWorld& world) : world_(world), search_(world) {}

  void advance(double duration, long step, std::vector<BodyState>& states, StepReport& report) override {
    report = {};
    std::vector<Wrench> impulses(states.size());
    // The contacts at a pose are known from the end of the step that led to it.
    if (!endsAt(motion_, states)) contactsAtRest(world_, states, search_, contacts_);
    for (const PairContacts& pair : contacts_) {
      const BodyState& shell = states[pair.shell_body];
      const BodyState& field = states[pair.field_body];
      Wrench impulse;
      for (const PointContact& point : pair.points) {
        const Vector3d push = duration * force(point, shell, field);
        impulse += {push, point.r_P.cross(push)};
      }
      addPair(impulse, shell.X_OB.translation() - field.X_OB.translation(), impulses[pair.shell_body],
              impulses[pair.field_body]);
    }
    report.reaction = reactionOf(impulses, states);
    kick(world_, impulses, duration, states);
    velocities_.clear();
    for (const BodyState& state : states) velocities_.push_back(state.velocity);
    drift(world_, velocities_, duration, step, states, motion_);
    contactsAtRest(world_, states, search_, contacts_);
    measure(contacts_, report);
  }

 private:
  /// Eq. 3 and the integrand of Eq. 10, at one pose, on the shell's body.
  Vector3d force(const PointContact& point, const BodyState& shell, const BodyState& field) const {
    const Vector3d N =
        world_.contact.normal == NormalSource::kShell ? point.inward : Vector3d(point.slope.normalized());
    const auto velocityAt = [](const BodyState& state, const Vector3d& r) {
      return Vector3d(state.velocity + Vector3d(state.X_OB.linear() * state.spin_B).cross(r));
    };
    return -point.stiffness * point.depth * N -
           point.damping * (velocityAt(shell, point.r_P) - velocityAt(field, point.r_F));
  }

  const RigidWorld& world_;
  ContactSearch search_;
  StepMotion motion_;
  std::vector<Vector3d> velocities_;
  std::vector<PairContacts> contacts_;
};

}  // namespace

std::unique_ptr<Integrator> makeDiscreteIntegrator(const RigidWorld& world) {
  return std::make_unique<DiscreteIntegrator>(world);
}

}  // namespace sdf_ccd
