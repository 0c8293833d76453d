/// Time per step of a simulation of a body dropped on a fixed copy of itself, with its shell traversed linearly and
/// through the sphere tree (paper, Table 4). Prints rows of results.csv.

#include <algorithm>
#include <cmath>

#include "dynamics/collision_shape.h"
#include "mesh/generated_mesh.h"
#include "results.h"
#include "sdf_ccd/simulation.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr double kSide = 0.2;         // longest side of every body's box [m]
constexpr double kStep = 1e-3;        // [s]
constexpr double kTimeLimit = 120.0;  // for both simulations together [s]

struct Drop {
  std::string name;
  TriangleMesh mesh;
  std::size_t points;  ///< wanted number; 0: the mesh's vertices
  int steps;           ///< as in the paper
};

/// The mesh scaled to kSide, with its centre of mass at the origin.
TriangleMesh placed(const TriangleMesh& mesh) {
  const double scale = kSide / boundingBox(mesh).sizes().maxCoeff();
  const TriangleMesh small = scaled(mesh, Vector3d::Constant(scale));
  return transformed(small, Isometry3d(Eigen::Translation3d(-massProperties(small, 1.0).center)));
}

std::shared_ptr<const CollisionShape> shapeOf(const Drop& drop, const TriangleMesh& mesh) {
  FieldOptions field;
  field.cells = 128;
  ShellOptions shell;
  shell.spacing = 10.0 * kSide;
  if (drop.points == 0) return makeShape(mesh, field, shell);
  shell.spacing = std::sqrt(2.0 * surfaceArea(mesh) / double(drop.points));
  for (int i = 0; i < 5; ++i) {
    shell.vertex_spacing = shell.spacing;
    const double ratio = double(sampleSurface(mesh, shell).size()) / double(drop.points);
    if (std::abs(ratio - 1.0) < 0.03) break;
    shell.spacing *= std::sqrt(ratio);
  }
  shell.vertex_spacing = shell.spacing;
  return makeShape(mesh, field, shell);
}

/// The shape with a single sphere around all points, so that every point is tested.
CollisionShape withoutTree(CollisionShape shape) {
  SphereTree::Node root = shape.tree.nodes.front();
  root.first_child = -1;
  shape.tree.nodes = {root};
  return shape;
}

Simulation simulation(const TriangleMesh& mesh, std::shared_ptr<const CollisionShape> shape) {
  const MassProperties mass = massProperties(mesh, 1000.0);
  RigidWorld world;
  world.contact.stiffness = 2e8;
  world.contact.damping = 2e5;
  world.bodies.resize(2);
  for (int i = 0; i < 2; ++i)
    world.bodies[i] = {i == 0 ? "lower" : "upper", shape, mass.mass, mass.inertia, i == 0, {}};
  std::vector<BodyState> states(2);
  states[1].X_OB = Isometry3d(Eigen::Translation3d(0.02, 0.01, 1.3 * kSide)) *
                   Isometry3d(Eigen::AngleAxisd(0.4, Vector3d(0.6, 0.8, 0.0)));
  return {std::move(world), std::move(states), Scheme::kContinuous, kStep};
}

/// Runs both simulations step by step in turn. @throws std::runtime_error if their numbers of contacts differ.
void run(const Drop& drop, int most) {
  const TriangleMesh mesh = placed(drop.mesh);
  const auto tree = shapeOf(drop, mesh);
  const auto linear = std::make_shared<const CollisionShape>(withoutTree(*tree));
  Simulation simulations[] = {simulation(mesh, linear), simulation(mesh, tree)};
  double seconds[] = {0.0, 0.0};
  std::vector<double> each[2];
  long contacts = 0;
  int steps = 0;
  while (steps < std::min(drop.steps, most) && seconds[0] + seconds[1] < kTimeLimit) {
    for (int k = 0; k < 2; ++k) {
      const int which = (k + steps) % 2;
      const double time = simulations[which].advance().run_time;
      seconds[which] += time;
      each[which].push_back(time);
    }
    if (simulations[0].last().contacts != simulations[1].last().contacts) {
      throw std::runtime_error(drop.name + ": the two traversals find other contacts");
    }
    contacts += simulations[0].last().contacts;
    ++steps;
  }
  const auto say = [&](const std::string& system, const std::string& metric, double value, const std::string& unit) {
    print({"drop", drop.name, system, metric, value, unit, steps});
  };
  for (int k = 0; k < 2; ++k) {
    const std::string system = k == 0 ? "linear" : "tree";
    std::sort(each[k].begin(), each[k].end());
    say(system, "us_per_step", 1e6 * seconds[k] / steps, "us");
    say(system, "us_per_step_median", 1e6 * each[k][each[k].size() / 2], "us");
    say(system, "us_per_step_max", 1e6 * each[k].back(), "us");
  }
  say("sdf_ccd", "points", double(tree->shell.size()), "points");
  say("sdf_ccd", "contacts", double(contacts), "points");
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full, quick;
  quick.quick = true;
  return runStudy(argc, argv, "Time per step of a body dropped on a copy of itself", full, quick,
                  [](const StudyOptions& options) {
                    std::vector<Drop> drops;
                    const auto add = [&](Drop drop) {
                      if (isWanted(options.cases, drop.name)) drops.push_back(std::move(drop));
                    };
                    for (const NamedMesh& named : studyMeshes(options)) {
                      if (named.name == "bunny3k") add({"bunny777", named.mesh, 777, 2600});
                      if (named.name == "dragon871k" && !options.quick) add({"dragon437k", named.mesh, 0, 1160});
                    }
                    if (drops.empty()) add({"blob777", sdf_ccd::blobMesh(0.1, 0.35, 777), 777, 2600});
                    add({"bowl2072", sdf_ccd::bowlMesh(0.1, 0.012, 64), 2072, 2000});
                    for (const Drop& drop : drops) run(drop, options.quick ? 500 : drop.steps);
                  });
}
