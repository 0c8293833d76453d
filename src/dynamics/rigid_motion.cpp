#include "dynamics/rigid_motion.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

constexpr double kAnglePerSubstep = 0.2;                                                // [rad]
constexpr double kSuzuki = 0.41449077179437573;                                         // 1 / (4 − ∛4)
constexpr double kParts[] = {kSuzuki, kSuzuki, 1.0 - 4.0 * kSuzuki, kSuzuki, kSuzuki};  // of a substep
constexpr double kAnglePerTime = 1.0;  // [rad], so that the shorter rotation between two poses is the true one
constexpr double kMaxAngle = 1e4;      // [rad] per step

Matrix3d skew(const Vector3d& v) {
  Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

Matrix3d orthonormal(const Matrix3d& R) {
  return Quaterniond(R).normalized().toRotationMatrix();
}

/// One conserving step, of which the midpoint spin Ω solves 2 I (Ω − Ω₀) = h' IΩ × Ω, by Newton's method. Cayley's
/// rotation by h'Ω is one about Ω by 2 atan(h'|Ω|/2), so h' = 2 tan(h|Ω|/2) / |Ω| makes it h|Ω|.
void conservingStep(const Matrix3d& inertia, double h, Matrix3d& R_OB, Vector3d& spin) {
  Vector3d middle = spin;
  for (int i = 0; i < 10; ++i) {
    const double speed = middle.norm(), scaled = 2.0 * std::tan(0.5 * h * speed) / speed;
    const Vector3d L = inertia * middle;
    const Vector3d residual = 2.0 * inertia * (middle - spin) - scaled * L.cross(middle);
    const Matrix3d slope = 2.0 * inertia - scaled * (skew(L) - skew(middle) * inertia);
    const Vector3d change = slope.partialPivLu().solve(residual);
    middle -= change;
    if (change.norm() <= 1e-15 * spin.norm()) break;
  }
  const double speed = middle.norm();
  R_OB = R_OB * Eigen::AngleAxisd(h * speed, middle / speed).toRotationMatrix();
  spin = 2.0 * middle - spin;
}

void requireBounded(const RigidBody& body, const BodyState& state, const Vector3d& velocity, double duration,
                    long step) {
  const auto refuse = [&](const std::string& what, double limit, const std::string& unit) {
    throw SimulationError(
        body.name, step,
        what + ", at most " + numberText(limit) + unit + " can be computed; shorten the step or lower the stiffness");
  };
  if (!velocity.allFinite() || !state.spin_B.allFinite() || !state.X_OB.matrix().allFinite()) {
    throw SimulationError(body.name, step, "its state is no longer finite; shorten the step or lower the stiffness");
  }
  const double travel = duration * velocity.norm(), angle = duration * state.spin_B.norm();
  if (!(travel <= kMaxDistance)) refuse("it would move " + numberText(travel) + " m in one step", kMaxDistance, " m");
  if (!(angle <= kMaxAngle)) refuse("it would rotate " + numberText(angle) + " rad in one step", kMaxAngle, " rad");
  const double distance = state.X_OB.translation().norm();
  if (!(distance <= kMaxDistance))
    refuse("it is " + numberText(distance) + " m from the scene's origin", kMaxDistance, " m");
}

}  // namespace

void rotateFreely(const Matrix3d& inertia_B, double duration, Matrix3d& R_OB, Vector3d& spin_B) {
  const double speed = spin_B.norm();
  if (speed == 0.0 || duration == 0.0) return;
  const Vector3d L = inertia_B * spin_B;
  if (L.cross(spin_B).norm() <= 1e-14 * L.norm() * speed) {
    R_OB = orthonormal(R_OB * Eigen::AngleAxisd(speed * duration, spin_B / speed).toRotationMatrix());
    return;
  }
  const int substeps = std::max(1, int(std::ceil(speed * duration / kAnglePerSubstep)));
  const double h = duration / substeps;
  for (int i = 0; i < substeps; ++i) {
    for (const double part : kParts) conservingStep(inertia_B, part * h, R_OB, spin_B);
  }
  R_OB = orthonormal(R_OB);
}

void restMotion(const std::vector<BodyState>& states, double duration, StepMotion& motion) {
  motion.times = {0.0, duration};
  motion.X_OB.resize(states.size());
  for (std::size_t b = 0; b < states.size(); ++b) motion.X_OB[b].assign(2, states[b].X_OB);
}

bool endsAt(const StepMotion& motion, const std::vector<BodyState>& states) {
  return std::equal(
      motion.X_OB.begin(), motion.X_OB.end(), states.begin(), states.end(),
      [](const auto& X_OB, const BodyState& state) { return X_OB.back().matrix() == state.X_OB.matrix(); });
}

void drift(const RigidWorld& world, const std::vector<Vector3d>& velocities, double duration, long step,
           std::vector<BodyState>& states, StepMotion& motion) {
  double angle = 0.0;
  for (std::size_t b = 0; b < states.size(); ++b) {
    if (world.bodies[b].fixed) continue;
    requireBounded(world.bodies[b], states[b], velocities[b], duration, step);
    angle = std::max(angle, duration * states[b].spin_B.norm());
  }
  const int pieces = std::max(1, int(std::ceil(angle / kAnglePerTime)));
  motion.times.resize(pieces + 1);
  for (int k = 0; k <= pieces; ++k) motion.times[k] = k == pieces ? duration : k * (duration / pieces);
  motion.X_OB.resize(states.size());
  for (std::size_t b = 0; b < states.size(); ++b) {
    BodyState& state = states[b];
    motion.X_OB[b].assign(pieces + 1, state.X_OB);
    if (world.bodies[b].fixed) continue;
    const Vector3d start = state.X_OB.translation();
    Matrix3d R_OB = state.X_OB.linear();
    for (int k = 1; k <= pieces; ++k) {
      rotateFreely(world.bodies[b].inertia, motion.times[k] - motion.times[k - 1], R_OB, state.spin_B);
      motion.X_OB[b][k].linear() = R_OB;
      motion.X_OB[b][k].translation() = start + motion.times[k] * velocities[b];
    }
    state.X_OB = motion.X_OB[b].back();
  }
}

}  // namespace sdf_ccd
