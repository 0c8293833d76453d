#include "explicit_step.h"

#include "contact/penalty.h"
#include "dynamics/collision_shape.h"

namespace sdf_ccd {
namespace {

/// Symplectic Euler under the last step's average contact force (paper §4).
class ContinuousIntegrator : public Integrator {
 public:
  explicit ContinuousIntegrator(const RigidWorld& world) : world_(world), search_(world) {}

  void advance(double duration, long step, std::vector<BodyState>& states, StepReport& report) override {
    report = {};
    if (average_.empty()) {  // before the first step the bodies are assumed to be at rest
      restMotion(states, duration, motion_);
      integrateAll(duration);
    }
    for (Wrench& wrench : average_) wrench = duration * wrench;
    report.reaction = reactionOf(average_, states);
    kick(world_, average_, duration, states);
    velocities_.clear();
    for (const BodyState& state : states) velocities_.push_back(state.velocity);
    drift(world_, velocities_, duration, step, states, motion_);
    integrateAll(duration);

    contactsAtRest(world_, states, search_, contacts_);
    measure(contacts_, report);
  }

 private:
  void integrateAll(double duration) {
    average_.assign(world_.bodies.size(), {});
    search_.run(motion_, [&](const RoleHits& role) { integrate(role, duration); });
  }

  /// Adds a role's impulses, divided by the step (Eq. 8, 9).
  void integrate(const RoleHits& role, double duration) {
    setFieldPoses(role);
    const ContactInput input{*world_.bodies[role.field_body].shape->field,
                             world_.bodies[role.shell_body].shape->shell,
                             role.path,
                             X_CF_,
                             {}};
    integrateContact(input, role.hits, world_.contact, {}, impulse_);
    const Vector3d p_FP =
        motion_.X_OB[role.shell_body].back().translation() - motion_.X_OB[role.field_body].back().translation();
    addPair((role.weight / duration) * impulse_.on_shell_body, p_FP, average_[role.shell_body],
            average_[role.field_body]);
  }

  /// Frame C: O's axes about the origin of the shell's body, which moves with a constant velocity during the step. The
  /// lever r of Eq. 5 is then that of the paper at every time.
  void setFieldPoses(const RoleHits& role) {
    const std::vector<Isometry3d>& X_OF = motion_.X_OB[role.field_body];
    const auto poseInC = [](const Matrix3d& R_OF, const Isometry3d& X_FP) {
      Isometry3d X_CF = Isometry3d::Identity();
      X_CF.linear() = R_OF;
      X_CF.translation() = -(R_OF * X_FP.translation());
      return X_CF;
    };
    X_CF_.assign(1, poseInC(X_OF.front().linear(), role.path.chords.front().X_FP_start));
    for (const Chord& chord : role.path.chords) {
      const double t0 = motion_.times[chord.interval], t1 = motion_.times[chord.interval + 1];
      const Matrix3d R_start = X_OF[chord.interval].linear();
      const Eigen::AngleAxisd turn(Matrix3d(R_start.transpose() * X_OF[chord.interval + 1].linear()));
      const double s = (chord.t_end - t0) / (t1 - t0);
      const Matrix3d R_OF = R_start * Eigen::AngleAxisd(s * turn.angle(), turn.axis()).toRotationMatrix();
      X_CF_.push_back(poseInC(R_OF, chord.X_FP_end));
    }
  }

  const RigidWorld& world_;
  ContactSearch search_;
  std::vector<Wrench> average_;  // contact force and torque of the last step per body, about its origin
  std::vector<Vector3d> velocities_;
  StepMotion motion_;
  std::vector<Isometry3d> X_CF_;
  ContactImpulse impulse_;
  std::vector<PairContacts> contacts_;
};

}  // namespace

std::unique_ptr<Integrator> makeContinuousIntegrator(const RigidWorld& world) {
  return std::make_unique<ContinuousIntegrator>(world);
}

}  // namespace sdf_ccd
