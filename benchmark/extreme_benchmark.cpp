/// Stiff and extreme scenes. With the implicit integrator each must stay stable within its limits of energy and depth,
/// or stop with an error that names the body, the step and the reason; the paper's schemes run for comparison. Prints
/// rows of results.csv.

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "common/number_text.h"
#include "dynamics/collision_shape.h"
#include "mesh/generated_mesh.h"
#include "oracle/bodies.h"
#include "results.h"
#include "sdf_ccd/simulation.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using namespace test;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTimeLimit = 60.0;  // [s]; longer counts as a hang

enum Outcome { kStable = 0, kStopped = 1, kBad = 2 };

struct Scene {
  RigidWorld world;
  std::vector<BodyState> states;
  double step = 1e-3;
  int steps = 1000;
  double depth_limit = 0.05;  // [m]
};

/// A scene and its expected outcome.
struct Case {
  std::string name;
  Outcome expected;
  std::function<Scene()> make;
};

/// Whether an error message names the body, the step and the reason, or an invalid option.
bool isClear(const std::string& message) {
  const bool of_body = message.find("body `") == 0 && message.find("`, step ") != std::string::npos;
  const bool of_option =
      message.find("time step") != std::string::npos || message.find("stiffness must be") != std::string::npos;
  return of_body || of_option;
}

void run(const Case& tried, Scheme scheme) {
  Outcome outcome = kBad;
  double gain = 0.0, deepest = 0.0;
  long contacts = 0;
  std::string why;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  try {
    const Scene scene = tried.make();
    Simulation simulation(scene.world, scene.states, scheme, scene.step);
    // Scale of the energy: the initial energy plus the work of gravity over the run.
    double masses = 0.0;
    for (const RigidBody& body : scene.world.bodies) masses += body.fixed ? 0.0 : body.mass;
    const StepRecord first = simulation.last();
    const double fall = scene.world.gravity.norm() * scene.step * scene.steps;
    const double scale = first.kinetic + first.elastic + 0.5 * masses * fall * fall + 1e-300;
    bool finite = true;
    // A run whose energy has doubled has failed.
    for (int i = 0; i < scene.steps && elapsed() < kTimeLimit && gain < 1.0; ++i) {
      const StepRecord& record = simulation.advance();
      gain = std::max(gain, (record.energy() - first.energy()) / scale);
      deepest = std::max(deepest, record.deepest);
      contacts += record.contacts;
      finite &= std::isfinite(record.energy()) && std::isfinite(record.deepest) && record.momentum.force.allFinite();
    }
    if (!finite)
      why = "not finite";
    else if (elapsed() >= kTimeLimit)
      why = "too slow";
    else if (gain > 1e-6)
      why = "energy grew";
    else if (deepest > scene.depth_limit)
      why = "too deep";
    else if (contacts == 0 && scene.world.contact.stiffness > 0.0)
      why = "never in contact";
    else
      outcome = kStable;
  } catch (const std::exception& error) {
    why = error.what();
    if (isClear(why)) outcome = kStopped;
  }
  const auto add = [&](const std::string& metric, double value, const std::string& unit) {
    print({"extreme", tried.name, toString(scheme), metric, value, unit});
  };
  add("outcome", outcome, "1");
  if (scheme == Scheme::kImplicit) add("expected", tried.expected, "1");
  add("energy_gain", gain, "1");
  add("max_depth", deepest, "m");
  add("run_time", elapsed(), "s");
  if (!why.empty()) std::fprintf(stderr, "extreme: %s, %s: %s\n", tried.name.c_str(), toString(scheme), why.c_str());
}

/// A box of `size` [m] that falls, tumbling, onto the ground from 1.5 `size` above it.
Scene tumble(double size = 0.1) {
  Scene scene;
  scene.world.contact.damping = 1e4;
  scene.world.bodies = {groundBody(),
                        primitiveBody("box", Box::fromSize(2.0 * Vector3d(0.5, 0.4, 0.3) * size), 1000.0, 0.2 * size)};
  scene.states = {at(Vector3d::Zero()), at({0, 0, 1.5 * size}, {0.3 * size, 0, 0}, {1, 2, 3})};
  scene.depth_limit = size;
  return scene;
}

Scene blobs(const Vector3d& apart) {
  Scene scene;
  scene.world.gravity.setZero();
  const RigidBody blob = meshBody("a", blobMesh(0.1, 0.3, 300), 1000.0, 48, 0.02);
  scene.world.bodies = {blob, blob};
  scene.world.bodies[1].name = "b";
  scene.states = {at(Vector3d::Zero()), at(apart)};
  scene.depth_limit = 0.11;
  return scene;
}

Scene resting(const RigidBody& body, double height) {
  Scene scene;
  scene.world.bodies = {groundBody(), body};
  scene.states = {at(Vector3d::Zero()), at({0, 0, height})};
  return scene;
}

std::vector<Case> physicalCases() {
  std::vector<Case> cases;
  for (int e = 0; e <= 12; e += 2) {
    const double k = std::pow(10.0, e);
    cases.push_back({"stiffness=" + numberText(k), kStable, [k] {
                       Scene scene = tumble();
                       scene.world.contact.stiffness_per = StiffnessPer::kPoint;
                       scene.world.contact.stiffness = k;
                       scene.world.contact.damping = 0.0;
                       if (k < 1e4) scene.depth_limit = 5.0;  // too soft to carry the box
                       return scene;
                     }});
  }
  for (const bool heavy_on_top : {true, false}) {
    cases.push_back({std::string("mass_ratio=1e6 ") + (heavy_on_top ? "heavy on light" : "light on heavy"), kStable,
                     [heavy_on_top] {
                       Scene scene;
                       const Primitive box = Box::fromSize({0.1, 0.1, 0.1});
                       scene.world.bodies = {groundBody(), primitiveBody("below", box, heavy_on_top ? 1.0 : 1e6, 0.02),
                                             primitiveBody("above", box, heavy_on_top ? 1e6 : 1.0, 0.02)};
                       scene.world.contact.stiffness = 1e11;  // 10⁶ kg/m³ on 0.1 m press 10 µm deep
                       scene.world.contact.damping = 1e7;
                       scene.states = {at(Vector3d::Zero()), at({0, 0, 0.051}), at({0, 0, 0.152})};
                       scene.depth_limit = 0.01;
                       return scene;
                     }});
  }
  for (int e = -6; e <= -1; ++e) {
    const double step = std::pow(10.0, e);
    cases.push_back({"step=" + numberText(step), kStable, [step] {
                       Scene scene = tumble();
                       scene.states[1].X_OB.translation().z() = 0.06;  // lands within 0.1 s
                       scene.states[1].velocity.z() = -1.0;
                       scene.step = step;
                       scene.steps = std::max(1000, int(std::ceil(0.1 / step)));
                       return scene;
                     }});
  }
  for (int e = -3; e <= 4; ++e) {
    const double speed = std::pow(10.0, e);
    cases.push_back({"speed=" + numberText(speed), kStable, [speed] {
                       Scene scene = tumble();
                       scene.states[1].velocity.z() = -speed;
                       scene.depth_limit = std::max(0.05, 1e-3 * speed);  // its travel in one step
                       return scene;
                     }});
  }
  cases.push_back({"spin=10000", kStable, [] {
                     Scene scene = tumble();
                     scene.states[1].spin_B = {6e3, 5e3, 6.2e3};
                     scene.steps = 300;
                     return scene;
                   }});
  for (int e = -5; e <= 4; ++e) {
    const double size = std::pow(10.0, e);
    cases.push_back({"size=" + numberText(size), kStable, [size] {
                       Scene scene = tumble(size);
                       const RigidBody blob = meshBody("blob", blobMesh(0.5 * size, 0.2, 200), 1000.0, 32, 0.2 * size);
                       scene.world.bodies.push_back(blob);
                       scene.states.push_back(at({0.1 * size, 0, 3.0 * size}));
                       for (const int b : {1, 2}) scene.states[b].velocity.z() = -2.0 * size;  // lands within a second
                       return scene;
                     }});
  }
  return cases;
}

std::vector<Case> placedCases() {
  std::vector<Case> cases;
  for (const double far : {0.0, 1e6}) {
    cases.push_back({"origin=" + numberText(far), kStable, [far] {
                       const SimulationSetup setup = parseSimulation(
                           "step: 0.001\nduration: 1\ncontact: {damping: 1.0e+4}\n"
                           "shapes: {box: {type: box, size: [0.1, 0.08, 0.06]}, ground: {type: plane}}\n"
                           "bodies: [{name: ground, shape: ground, fixed: true, xyz: [" +
                               std::to_string(far) + ", 0, " + std::to_string(far) +
                               "]}, {name: box, shape: box, rpy: [0.5, 0.3, 0], xyz: [" + std::to_string(far) +
                               ", 0, " + std::to_string(far + 0.125) + "]}]",
                           ".");
                       return Scene{setup.world, setup.states, setup.step};
                     }});
  }
  cases.push_back({"deep overlap at the start", kStable, [] { return blobs({0.02, 0.0, 0.01}); }});
  cases.push_back({"shells exactly coincident", kStable, [] { return blobs(Vector3d::Zero()); }});
  cases.push_back({"boxes face to face", kStable, [] {
                     Scene scene;
                     const RigidBody box = primitiveBody("below", Box::fromSize({0.1, 0.1, 0.1}), 1000.0, 0.02);
                     scene.world.bodies = {groundBody(), box, box};
                     scene.world.bodies[2].name = "above";
                     scene.states = {at(Vector3d::Zero()), at({0, 0, 0.05}), at({0, 0, 0.15})};
                     return scene;
                   }});
  cases.push_back({"plate of a tenth of a cell", kStable, [] {
                     Scene scene;
                     scene.world.bodies = {
                         meshBody("plate", boxMesh({0.1, 0.1, 0.5 * 0.2 / 64 / 10}), 1000.0, 64, 0.01),
                         meshBody("ball", icosphere(0.05, 3), 1000.0, 48, 0.01)};
                     scene.world.bodies[0].fixed = true;
                     scene.states = {at(Vector3d::Zero()), at({0, 0, 0.2})};
                     return scene;
                   }});
  cases.push_back({"wholly inside another", kStable, [] {
                     Scene scene;
                     scene.world.bodies = {groundBody(), primitiveBody("outer", Sphere{0.2}, 1000.0, 0.03),
                                           primitiveBody("inner", Box::fromSize({0.04, 0.04, 0.04}), 1000.0, 0.01)};
                     scene.states = {at(Vector3d::Zero()), at({0, 0, 0.2}), at({0.01, 0.02, 0.21})};
                     scene.depth_limit = 0.2;
                     return scene;
                   }});
  return cases;
}

std::vector<Case> degenerateCases() {
  std::vector<Case> cases;
  cases.push_back({"empty body", kStopped, [] {
                     RigidBody empty = pointBody("empty", 1.0);
                     empty.shape = std::make_shared<CollisionShape>();
                     return resting(empty, 0.1);
                   }});
  cases.push_back({"one point", kStable, [] { return resting(pointBody("point", 1.0), 0.1); }});
  TriangleMesh triangle;
  triangle.vertices = {{-0.05, -0.03, 0}, {0.05, -0.03, 0}, {0, 0.06, 0}};
  triangle.triangles = {{0, 1, 2}};
  cases.push_back({"one triangle with a density", kStopped, [] {
                     const auto file = std::filesystem::temp_directory_path() / "sdf_ccd_one_triangle.off";
                     std::ofstream(file) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
                     const SimulationSetup setup = parseSimulation(
                         "step: 0.001\nduration: 1\nshapes: {triangle: {type: mesh, file: " + file.string() +
                             ", cells: 32}}\nbodies: [{name: triangle, shape: triangle, density: 1000}]",
                         ".");
                     return Scene{setup.world, setup.states, setup.step};
                   }});
  cases.push_back({"one triangle with a mass", kStable, [triangle] {
                     RigidBody body = pointBody("triangle", 0.1);
                     body.inertia = Vector3d(1, 1, 2).asDiagonal() * 1e-4;
                     FieldOptions field;
                     field.cells = 32;
                     ShellOptions shell;
                     shell.spacing = 0.02;
                     body.shape = makeShape(triangle, field, shell);
                     return resting(body, 0.1);
                   }});
  for (const double bad : {0.0, -1.0, kInfinity, std::nan("")}) {
    cases.push_back({"mass=" + numberText(bad), kStopped, [bad] {
                       Scene scene = tumble();
                       scene.world.bodies[1].mass = bad;
                       return scene;
                     }});
    cases.push_back({"step=" + numberText(bad), kStopped, [bad] {
                       Scene scene = tumble();
                       scene.step = bad;
                       return scene;
                     }});
    // With zero stiffness the body falls through the ground, as requested.
    cases.push_back({"stiffness=" + numberText(bad), bad == 0.0 ? kStable : kStopped, [bad] {
                       Scene scene = tumble();
                       scene.world.contact.stiffness = bad;
                       scene.depth_limit = 10.0;
                       return scene;
                     }});
  }
  return cases;
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd;
  using namespace sdf_ccd::benchmark;
  const StudyOptions options;
  return runStudy(argc, argv, "Stiff and extreme scenes", options, options, [](const StudyOptions& given) {
    for (const auto& cases : {physicalCases(), placedCases(), degenerateCases()}) {
      for (const Case& tried : cases) {
        if (!isWanted(given.cases, tried.name)) continue;
        for (const Scheme scheme : {Scheme::kImplicit, Scheme::kContinuous, Scheme::kDiscrete}) run(tried, scheme);
      }
    }
  });
}
