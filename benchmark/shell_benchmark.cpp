/// Time per moving point shell: linear traversal, the sphere tree, and FCL on the meshes (paper, Tables 3 and 4).
/// Prints rows of results.csv.

#include <algorithm>
#include <chrono>
#include <cmath>

#include "motion_cases.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"
#include "study_fields.h"

namespace sdf_ccd::benchmark {
namespace {

/// Value of ShellPlan::points for a shell of the mesh's vertices.
constexpr std::size_t kVertices = 0;

struct ShellPlan {
  std::string name, mesh;
  std::size_t points;
  std::vector<std::string> cases;
};

PointShell sampled(const TriangleMesh& mesh, std::size_t points) {
  ShellOptions options;
  options.spacing = 10.0 * studyBox(mesh).sizes().x();
  if (points == kVertices) return sampleSurface(mesh, options);
  options.spacing = std::sqrt(2.0 * surfaceArea(mesh) / double(points));
  PointShell shell;
  for (int i = 0; i < 6; ++i) {
    options.vertex_spacing = options.spacing;
    shell = sampleSurface(mesh, options);
    const double ratio = double(shell.size()) / double(points);
    if (std::abs(ratio - 1.0) < 0.03) break;
    options.spacing *= std::sqrt(ratio);
  }
  return shell;
}

/// Number of pairs that the system can query in about `seconds`, extrapolated from the first few.
std::size_t affordable(ShellSystem& system, const std::vector<PosePair>& pairs, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  double spent = 0.0;
  std::size_t done = 0;
  while (done < pairs.size() && spent < 0.2 * seconds) {
    system.run(&pairs[done++], 1);
    spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return std::clamp<std::size_t>(std::size_t(seconds / spent * double(done)), 1, pairs.size());
}

/// Times linear traversal and tree on the same pairs, as many as the linear one can do in the time, other libraries on
/// the first of those, and the tree on all pairs too. @throws std::runtime_error if tree and linear traversal differ.
void compare(const std::string& row, const ShellSystems& systems, const std::vector<PosePair>& pairs,
             const StudyOptions& options) {
  const double seconds = 10.0 * options.measure.seconds;
  std::vector<std::size_t> counts;
  for (const auto& system : systems) {
    const std::size_t count = system->name() == "tree" ? pairs.size() : affordable(*system, pairs, seconds);
    counts.push_back(counts.empty() ? count : std::min(count, counts.front()));
  }
  const std::size_t counted = *std::min_element(counts.begin(), counts.end());
  std::vector<Task> tasks;
  std::vector<ShellAnswer> answers;
  for (std::size_t k = 0; k < systems.size(); ++k) {
    ShellSystem* system = systems[k].get();
    answers.push_back(system->run(pairs.data(), counted));
    if (k > 0 && system->name() == "tree" && answers[k].contacts != answers[0].contacts) {
      throw std::runtime_error(row + ": the tree finds " + std::to_string(answers[k].contacts) + " contacts, linear " +
                               std::to_string(answers[0].contacts));
    }
    tasks.push_back({system->name(), [system, &pairs, count = counts[k]](std::size_t) {
                       system->run(pairs.data(), count);
                       return count;
                     }});
  }
  const std::vector<Spread> spreads = measure(tasks, options.measure);
  for (const auto& system : systems) {
    if (system->name() != "tree") continue;
    const std::vector<Spread> spread = measure({{"tree",
                                                 [&](std::size_t) {
                                                   system->run(pairs.data(), pairs.size());
                                                   return pairs.size();
                                                 }}},
                                               options.measure);
    print({"shell", row, "tree", "us_per_pair_all", 0.0, "us", options.measure.runs}, spread[0], 1e6);
  }
  const std::string of = "of " + std::to_string(counted) + " pairs";
  for (std::size_t k = 0; k < systems.size(); ++k) {
    const std::string& name = tasks[k].system;
    print({"shell", row, name, "us_per_pair", 0.0, "us", options.measure.runs}, spreads[k], 1e6);
    print({"shell", row, name, "pairs", double(counts[k]), "1", 1});
    print({"shell", row, name, "pairs_in_contact", double(answers[k].pairs_in_contact), of, 1});
    if (name != "fcl") print({"shell", row, name, "contacts", double(answers[k].contacts), of, 1});
  }
}

void study(const ShellPlan& plan, const NamedMesh& named, const StudyOptions& options) {
  PointShell shell = sampled(named.mesh, plan.points);
  const SphereTree tree = buildSphereTree(shell);
  const StudyField wanted = studyFields(named, options).front();
  withField(named, wanted, [&](const DistanceField& field) {
    const ShellSubject subject{named.mesh, field, named.mesh, shell, tree};
    ShellSystems systems;
    for (const ShellFactory& factory : shellFactories()) factory(subject, systems);
    std::stable_partition(systems.begin(), systems.end(), [](const auto& s) { return s->name() == "linear"; });
    const MotionCases motions(subject);
    for (const std::string& name : plan.cases) {
      if (!isWanted(options.cases, name)) continue;
      const std::string row = plan.name + "/" + name;
      print({"shell", row, "sdf_ccd", "points", double(shell.size()), "1", 1});
      compare(row, systems, motions.pairs(name, std::size_t(options.pairs)), options);
    }
  });
}

void studyAll(const StudyOptions& options) {
  const std::vector<std::string> all{"random", "small", "deep", "clear"};
  const std::vector<ShellPlan> plans = {
      {"shell800", "bunny3k", 800, all},     {"shell2k", "bunny3k", 2000, all},
      {"shell20k", "bunny75k", 20'000, all}, {"shell437k", "dragon871k", kVertices, all},
      {"shell2k", "link", 2000, {"links"}},  {"shell2k", "torus", 2000, all}};
  for (const NamedMesh& named : studyMeshes(options)) {
    for (const ShellPlan& plan : plans) {
      if (plan.mesh == named.name) study(plan, named, options);
    }
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.errors = {"1e-3"};
  StudyOptions quick = full;
  quick.meshes = {"bunny3k", "link", "torus"};
  quick.cells = {128};
  quick.pairs = 100;
  quick.measure.seconds = 0.01;
  return runStudy(argc, argv, "Time per moving point shell", full, quick, studyAll);
}
