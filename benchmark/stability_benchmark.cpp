/// Stability of the integrators: the largest stable step of a persistent contact over the damping ratio with its closed
/// form, the restitution of impacts, and the three statements of Xu & Barbič's Figure 6. Prints rows of results.csv.

#include <cmath>
#include <optional>
#include <string>

#include "common/number_text.h"
#include "mesh/generated_mesh.h"
#include "oracle/bodies.h"
#include "oracle/persistent_contact.h"
#include "results.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using namespace test;

constexpr double kHighest = 1e4;  // largest s that is tried
constexpr int kPhases = 32;
constexpr Scheme kSchemes[] = {Scheme::kContinuous, Scheme::kDiscrete, Scheme::kImplicit};

void add(const std::string& name, const std::string& system, const std::string& metric, double value,
         const std::string& unit, int runs = 1) {
  print({"stability", name, system, metric, value, unit, runs});
}

void chart(int ratios, int steps) {
  for (int i = 1; i <= ratios; ++i) {
    const double zeta = double(i) / ratios;
    const std::string name = "zeta=" + numberText(zeta);
    for (const Scheme scheme : kSchemes)
      add(name, toString(scheme), "s_max", largestStable(scheme, zeta, kHighest, steps), "1");
    add(name, "closed_form_continuous", "s_max", continuousLimit(zeta), "1");
    add(name, "closed_form_discrete", "s_max", discreteLimit(zeta), "1");
  }
}

/// Results of impacts of a point at 1 m/s under one scheme, for kPhases equally spaced phases of the impact in a step.
struct Impacts {
  double mean_rebound = 0.0;     // speed after the impact [m/s]; exactly 1 without damping
  double highest_rebound = 0.0;  // [m/s]
  double deepest = 0.0;          // [m]
};

Impacts impacts(Scheme scheme, double zeta, double omega, double step) {
  Impacts result;
  for (int phase = 0; phase < kPhases; ++phase) {
    RigidWorld world;
    world.gravity.setZero();
    world.bodies = {groundBody(), pointBody("point", 1.0)};
    world.contact.stiffness_per = StiffnessPer::kPoint;
    world.contact.stiffness = omega * omega;
    world.contact.damping = 2.0 * zeta * omega;
    const double height = step * (1.0 + (phase + 0.5) / kPhases);
    Simulation simulation(world, {at(Vector3d::Zero()), at({0, 0, height}, {0, 0, -1.0})}, scheme, step);
    const int steps = 20 + int(std::ceil(20.0 / (omega * step)));
    for (int i = 0; i < steps; ++i) result.deepest = std::max(result.deepest, simulation.advance().deepest);
    const double back = std::abs(simulation.states()[1].velocity.z());
    result.mean_rebound += back / kPhases;
    result.highest_rebound = std::max(result.highest_rebound, back);
  }
  return result;
}

void restitution(double s) {
  for (const Scheme scheme : kSchemes) {
    const Impacts found = impacts(scheme, 0.0, kOmega, s / kOmega);
    add("impact s=" + numberText(s), toString(scheme), "restitution", found.mean_rebound, "1", kPhases);
    add("impact s=" + numberText(s), toString(scheme), "restitution_max", found.highest_rebound, "1", kPhases);
  }
}

/// Largest step [s], on a ladder of factors 1.02, up to which no impact rebounds faster or goes deeper than `depth`.
double largestImpactStep(Scheme scheme, double zeta, double depth = 1e9) {
  double s = 0.02;
  while (s < 100.0) {
    const Impacts found = impacts(scheme, zeta, kOmega, 1.02 * s / kOmega);
    if (found.highest_rebound > 1.001 || found.deepest > depth) break;
    s *= 1.02;
  }
  return s / kOmega;
}

/// The three statements of Figure 6 for impacts of a point.
void pointFigure6(double zeta) {
  const std::string row = "figure6_point zeta=" + numberText(zeta);
  const double continuous = largestImpactStep(Scheme::kContinuous, zeta);
  const double discrete = largestImpactStep(Scheme::kDiscrete, zeta);
  add(row, "continuous", "s_max", continuous * kOmega, "1", kPhases);
  add(row, "discrete", "s_max", discrete * kOmega, "1", kPhases);
  add(row, "continuous/discrete", "step_ratio", continuous / discrete, "1", kPhases);
  // The limit is one of ωΔt, whatever the stiffness.
  const double softened = kOmega * discrete / continuous;
  const double depth = impacts(Scheme::kContinuous, zeta, kOmega, continuous).deepest;
  add(row, "discrete/continuous", "depth_ratio", impacts(Scheme::kDiscrete, zeta, softened, continuous).deepest / depth,
      "1", kPhases);
  const double depth_to_match = impacts(Scheme::kDiscrete, zeta, kOmega, discrete).deepest;
  add(row, "continuous/discrete", "step_ratio_matched",
      largestImpactStep(Scheme::kContinuous, zeta, 1.001 * depth_to_match) / discrete, "1", kPhases);
}

/// A blob of 777 points that falls onto a fixed copy of itself and the ground, as in the paper's §5: stiffness per
/// point, midpoint rule.
class Drop {
 public:
  explicit Drop(double zeta) : blob_(meshBody("upper", blobMesh(0.1, 0.35, 777), 1000.0, 64, 0.02)) {
    world_.bodies = {groundBody(), blob_, blob_};
    world_.bodies[1].name = "lower";
    world_.bodies[1].fixed = true;
    world_.contact.stiffness_per = StiffnessPer::kPoint;
    world_.contact.quadrature = Quadrature::kMidpoint;
    setStiffness(1e5, zeta);
  }

  /// Sets the damping for the damping ratio of the body resting on ten such points (each has half its weight per role).
  void setStiffness(double stiffness, double zeta) {
    world_.contact.stiffness = stiffness;
    world_.contact.damping = 2.0 * zeta * std::sqrt(stiffness * blob_.mass / 5.0);
  }
  double stiffness() const { return world_.contact.stiffness; }

  /// Depth of the deepest point, if the run is stable: it ends without an error, and the energy never exceeds the
  /// initial one by more than the energy m g h of the drop. (With a smaller tolerance, deep penetrations would count as
  /// unstable.)
  std::optional<double> deepest(Scheme scheme, double step, double duration) const {
    const double fall = 0.1;
    try {
      Simulation simulation(world_, {at(Vector3d::Zero()), at({0, 0, 0.12}), at({0.02, 0.01, 0.35 + fall})}, scheme,
                            step);
      const double limit = simulation.last().energy() + blob_.mass * 9.81 * fall;
      double deepest = 0.0;
      while (simulation.last().time < duration) {
        const StepRecord& record = simulation.advance();
        if (record.energy() > limit) return std::nullopt;
        deepest = std::max(deepest, record.deepest);
      }
      return deepest;
    } catch (const SimulationError&) {
      return std::nullopt;
    }
  }

  /// Largest step [s], on a ladder of factors 1.05, up to which all runs are stable and no deeper than `depth` [m].
  double largestStep(Scheme scheme, double duration, double depth = 1e9) const {
    double step = 1e-4;
    for (;;) {
      const std::optional<double> found = deepest(scheme, step * 1.05, duration);
      if (!found || *found > depth || step > 0.05) return step;
      step *= 1.05;
    }
  }

 private:
  RigidBody blob_;
  RigidWorld world_;
};

/// The three statements of Figure 6 for the drop, until a little after the first impact or until rest.
void figure6(const std::string& name, double zeta, double duration) {
  Drop drop(zeta);
  const std::string row = "figure6_" + name + " zeta=" + numberText(zeta);
  const double continuous = drop.largestStep(Scheme::kContinuous, duration);
  const double discrete = drop.largestStep(Scheme::kDiscrete, duration);
  add(row, "continuous", "step_max", continuous, "s");
  add(row, "discrete", "step_max", discrete, "s");
  add(row, "continuous/discrete", "step_ratio", continuous / discrete, "1");

  // At the continuous scheme's step: the largest stiffness up to which all smaller ones are stable too.
  const double depth = *drop.deepest(Scheme::kContinuous, continuous, duration);
  const double stiffness = drop.stiffness();
  double softened = 0.0, depth_softened = 0.0;
  for (double k = stiffness / 100.0; k <= stiffness * 1.01; k *= 1.05) {
    drop.setStiffness(k, zeta);
    const std::optional<double> found = drop.deepest(Scheme::kDiscrete, continuous, duration);
    if (!found) break;
    softened = k;
    depth_softened = *found;
  }
  drop.setStiffness(stiffness, zeta);
  if (softened > 0.0) {
    add(row, "discrete", "stiffness_ratio", softened / stiffness, "1");
    add(row, "discrete/continuous", "depth_ratio", depth_softened / depth, "1");
  }

  // The continuous scheme's largest step that is no deeper than the discrete scheme at its own.
  const double depth_to_match = *drop.deepest(Scheme::kDiscrete, discrete, duration);
  const double matched = drop.largestStep(Scheme::kContinuous, duration, 1.001 * depth_to_match);
  add(row, "continuous", "step_max_matched", matched, "s");
  add(row, "continuous/discrete", "step_ratio_matched", matched / discrete, "1");
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  StudyOptions quick = full;
  quick.cases = {"chart", "impact"};
  return runStudy(argc, argv, "Stability of the integrators; cases: chart, impact, figure6", full, quick,
                  [](const StudyOptions& options) {
                    if (isWanted(options.cases, "chart")) chart(20, 20000);
                    if (isWanted(options.cases, "impact")) {
                      for (const double s : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0}) restitution(s);
                      for (const double zeta : {0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0}) pointFigure6(zeta);
                    }
                    if (!isWanted(options.cases, "figure6")) return;
                    for (const double zeta : {0.1, 0.25, 0.5, 1.0}) {
                      figure6("impact", zeta, 0.3);
                      figure6("rest", zeta, 2.0);
                    }
                  });
}
