/// The study `step`: error over the time step. Both scenes have closed forms: a point of 1 kg and a half-space, with
/// ω = √(k/m) = 1000 /s.

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include <fmt/format.h>

#include "common/pi.h"
#include "dynamics/collision_shape.h"
#include "random_inputs.h"
#include "sdf_ccd/simulation.h"
#include "shell/point_shell.h"
#include "studies.h"

namespace sdf_ccd::precision {
namespace {

constexpr double kOmega = 1000.0;               // [rad/s]
constexpr double kPeriod = 2.0 * kPi / kOmega;  // [s]
constexpr int kPeriods = 5;
constexpr int kScenes = 20;
constexpr double kUseless = 10.0;  // errors are clamped to this: the scheme is unstable

RigidWorld pointOnGround(double zeta) {
  RigidBody ground, point;
  ground.name = "ground";
  ground.fixed = true;
  ground.shape = makeShape(Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), ShellOptions{});
  point.name = "point";
  point.mass = 1.0;
  point.inertia = Matrix3d::Identity();
  PointShell shell;
  shell.add(Vector3d::Zero(), -Vector3d::UnitZ(), 1.0F);
  point.shape = makeShape(shell);
  RigidWorld world;
  world.bodies = {ground, point};
  world.contact.stiffness_per = StiffnessPer::kPoint;
  world.contact.stiffness = kOmega * kOmega;
  world.contact.damping = 2.0 * zeta * kOmega;
  return world;
}

/// The point at height z [m] with vertical velocity v [m/s]; the ground at rest.
std::vector<BodyState> pointAt(double z, double v) {
  std::vector<BodyState> states(2);
  states[1].X_OB.translation() = Vector3d(0.0, 0.0, z);
  states[1].velocity = Vector3d(0.0, 0.0, v);
  return states;
}

struct Scene {
  double zeta;   ///< damping ratio
  double start;  ///< resting: height above equilibrium, in resting depths. Impact: its phase within a step, [0, 1)
};

/// Persistent contact: the largest deviation from the damped oscillation over five periods, relative to the amplitude.
double restingError(Scheme scheme, double step, const Scene& scene) {
  RigidWorld world = pointOnGround(scene.zeta);
  const double rest = world.gravity.z() / (kOmega * kOmega), amplitude = scene.start * std::abs(rest);
  const double damped = kOmega * std::sqrt(1.0 - scene.zeta * scene.zeta);
  Simulation simulation(std::move(world), pointAt(rest + amplitude, 0.0), scheme, step);
  double worst = 0.0;
  const int steps = int(std::ceil(kPeriods * kPeriod / step));
  for (int i = 0; i < steps; ++i) {
    const double t = simulation.advance().time;
    const double exact = amplitude * std::exp(-scene.zeta * kOmega * t) *
                         (std::cos(damped * t) + scene.zeta * kOmega / damped * std::sin(damped * t));
    const double found = simulation.states()[1].X_OB.translation().z() - rest;
    worst = std::max(worst, std::abs(found - exact) / amplitude);
    if (!(worst < kUseless)) break;
  }
  return worst;
}

/// An impact at 1 m/s without gravity and damping: the error of the rebound's speed, which is 1 m/s exactly.
double impactError(Scheme scheme, double step, const Scene& scene) {
  RigidWorld world = pointOnGround(0.0);
  world.gravity.setZero();
  Simulation simulation(std::move(world), pointAt(step * (1.0 + scene.start), -1.0), scheme, step);
  const int steps = 5 + int(std::ceil(kPeriod / step));
  for (int i = 0; i < steps; ++i) simulation.advance();
  return std::min(std::abs(simulation.states()[1].velocity.z() - 1.0), kUseless);
}

double errorOf(double (*run)(Scheme, double, const Scene&), Scheme scheme, double step, const Scene& scene) {
  try {
    return run(scheme, step, scene);
  } catch (const SimulationError&) {
    return kUseless;
  }
}

}  // namespace

StudyResult stepStudy(const StudyInput& input) {
  StudyResult result{"step",
                     "Dynamics: error against closed forms over the time step",
                     "time step [s]",
                     "scene (five periods of rest; one impact)",
                     {}};
  Random random(5);
  std::vector<Scene> scenes;
  for (int i = 0; i < kScenes; ++i) scenes.push_back({uniform(random, 0.05, 0.5), uniform(random, 0.1, 0.5)});
  std::vector<double> phases{0.8, 0.25, 0.08, 0.025};  // ωΔt
  if (!input.quick) phases.push_back(0.008);
  using Run = double (*)(Scheme, double, const Scene&);
  const std::tuple<const char*, const char*, Run> cases[] = {
      {"persistent contact: deviation", "amplitudes", &restingError},
      {"impact without damping: speed of the rebound", "of the speed", &impactError}};
  double done = 0.0;
  for (const auto& [quantity, unit, run] : cases) {
    std::vector<System<double>> systems;
    for (const Scheme scheme : {Scheme::kContinuous, Scheme::kDiscrete, Scheme::kImplicit}) {
      for (const double s : phases) {
        const double step = s / kOmega;
        systems.push_back({{toString(scheme), fmt::format("{:g} ms", 1e3 * step), step},
                           [&scenes, run = run, scheme, step](std::vector<double>& errors) {
                             for (std::size_t i = 0; i < scenes.size(); ++i)
                               errors[i] = errorOf(run, scheme, step, scenes[i]);
                           }});
      }
    }
    for (Measurement& row :
         measure<double>(systems, scenes.size(), {{quantity, unit, [](std::size_t, double error) { return error; }}},
                         [&](double share) { input.progress(0.5 * (done + share)); }))
      result.rows.push_back(std::move(row));
    done += 1.0;
  }
  return result;
}

}  // namespace sdf_ccd::precision
