/// How queries scale with threads, with the points of a shell and with the cells of a field. Prints rows of
/// results.csv.

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <thread>

#include <tbb/task_arena.h>

#include "motion_cases.h"
#include "precision/random_inputs.h"
#include "segment_cases.h"
#include "segment_system.h"
#include "shell/point_shell.h"
#include "study_fields.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr int kThreads = 2;

/// A shell of independent random points, with its sphere tree. Queries use no normals or areas.
struct PlainShell {
  PlainShell(const TriangleMesh& mesh, std::size_t points) {
    test::Random random(1);
    const precision::SurfaceSampler surface(mesh);
    while (shell.size() < points) shell.add(surface(random), Vector3d::UnitZ(), 0.0F);
    tree = buildSphereTree(shell);
  }

  PointShell shell;
  SphereTree tree;
};

std::unique_ptr<ShellSystem> treeSystem(const ShellSubject& subject) {
  ShellSystems systems;
  for (const ShellFactory& factory : shellFactories()) factory(subject, systems);
  for (auto& system : systems) {
    if (system->name() == "tree") return std::move(system);
  }
  throw std::logic_error("there is no system `tree`");
}

SegmentSystems fieldSystems(const FieldSubject& subject) {
  SegmentSystems systems;
  for (const FieldFactory& factory : fieldFactories()) factory(subject, systems);
  return systems;
}

/// Calls work(k) for k = 0 … threads − 1, each on its own thread; parallel algorithms within a call stay on its
/// thread.
void onThreads(int threads, const std::function<void(int)>& work) {
  const auto confined = [&](int k) { tbb::task_arena(1).execute([&] { work(k); }); };
  std::vector<std::thread> others;
  for (int k = 1; k < threads; ++k) others.emplace_back(confined, k);
  confined(0);
  for (std::thread& thread : others) thread.join();
}

void printAll(const std::vector<std::string>& rows, const std::vector<Task>& tasks, const Row& row,
              const MeasureOptions& options, double scale) {
  const std::vector<Spread> spreads = measure(tasks, options);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    print({"scaling", rows[k], tasks[k].system, row.metric, 0.0, row.unit, options.runs}, spreads[k], scale);
  }
}

/// Shells of 10³ to 10⁷ points.
void studyPoints(const NamedMesh& named, const DistanceField& field, const StudyOptions& options) {
  const std::size_t largest = options.quick ? 100'000 : 10'000'000;
  for (std::size_t points = 1000; points <= largest; points *= 10) {
    const PlainShell plain(named.mesh, points);
    const ShellSubject subject{named.mesh, field, named.mesh, plain.shell, plain.tree};
    const auto system = treeSystem(subject);
    for (const std::string name : {"random", "small"}) {
      const std::vector<PosePair> pairs = MotionCases(subject).pairs(name, std::size_t(std::min(options.pairs, 100)));
      const auto all = [&](std::size_t) {
        system->run(pairs.data(), pairs.size());
        return pairs.size();
      };
      printAll({named.name + "/points" + std::to_string(points) + "/" + name}, {{"tree", all}},
               {"", "", "", "us_per_pair", 0.0, "us"}, options.measure, 1e6);
    }
  }
}

/// Fields over the number of cells.
void studyCells(const NamedMesh& named, const StudyOptions& options) {
  const std::vector<Segment> segments = segmentCases(named.mesh, options.segments).front().segments;
  for (const StudyField& wanted : studyFields(named, options)) {
    withField(named, wanted, [&](const DistanceField& field) {
      const SegmentSystems systems = fieldSystems({named.mesh, field, 0, false});
      std::vector<Task> tasks;
      for (const auto& system : systems) {
        tasks.push_back({system->name(), [&](std::size_t) {
                           system->run(segments.data(), segments.size(), {});
                           return segments.size();
                         }});
      }
      printAll(std::vector<std::string>(tasks.size(), wanted.name + "/A/first"), tasks,
               {"", "", "", "ns_per_segment", 0.0, "ns"}, options.measure, 1e9);
      print({"scaling", wanted.name + "/A/first", "sdf_ccd", "bytes", double(field.bytes()), "B", 1});
    });
  }
}

/// The same work on one thread and on two, in turn, by wall-clock time.
void studyThreads(const NamedMesh& named, const DistanceField& field, const StudyOptions& options) {
  const std::vector<Segment> segments = segmentCases(named.mesh, options.segments).front().segments;
  const PlainShell plain(named.mesh, 20'000);
  const ShellSubject subject{named.mesh, field, named.mesh, plain.shell, plain.tree};
  const std::vector<PosePair> pairs = MotionCases(subject).pairs("random", std::size_t(options.pairs));
  std::vector<SegmentSystems> systems;  // per thread
  ShellSystems trees;
  for (int k = 0; k < kThreads; ++k) {
    systems.push_back(fieldSystems({named.mesh, field, 0, false}));
    trees.push_back(treeSystem(subject));
  }
  MeasureOptions measured = options.measure;
  measured.wall_clock = true;
  std::vector<std::string> segment_rows, shell_rows;
  std::vector<Task> segment_tasks, shell_tasks;
  for (int threads = 1; threads <= kThreads; ++threads) {
    const std::string ending = "/threads" + std::to_string(threads);
    for (std::size_t which = 0; which < systems[0].size(); ++which) {
      segment_rows.push_back(named.name + "/A/first" + ending);
      segment_tasks.push_back(
          {systems[0][which]->name(), [&, threads, which](std::size_t) {
             SegmentSystem& first = *systems[0][which];
             if (first.batched()) {  // such a system uses several threads itself
               tbb::task_arena(threads).execute([&] { first.run(segments.data(), segments.size(), {}); });
               return segments.size();
             }
             const std::size_t share = segments.size() / std::size_t(threads);
             onThreads(threads,
                       [&](int k) { systems[k][which]->run(segments.data() + std::size_t(k) * share, share, {}); });
             return share * std::size_t(threads);
           }});
    }
    shell_rows.push_back(named.name + "/shell20k/random" + ending);
    shell_tasks.push_back({"tree", [&, threads](std::size_t) {
                             const std::size_t share = pairs.size() / std::size_t(threads);
                             onThreads(threads,
                                       [&](int k) { trees[k]->run(pairs.data() + std::size_t(k) * share, share); });
                             return share * std::size_t(threads);
                           }});
  }
  printAll(segment_rows, segment_tasks, {"", "", "", "ns_per_segment", 0.0, "ns"}, measured, 1e9);
  printAll(shell_rows, shell_tasks, {"", "", "", "us_per_pair", 0.0, "us"}, measured, 1e6);
}

void studyAll(const StudyOptions& options) {
  for (const NamedMesh& named : studyMeshes(options)) {
    studyCells(named, options);
    StudyOptions one = options;
    one.cells.clear();
    for (const StudyField& wanted : studyFields(named, one)) {
      withField(named, wanted, [&](const DistanceField& field) {
        studyThreads(named, field, options);
        studyPoints(named, field, options);
      });
    }
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.cells = {32, 64, 128, 256, 512, 1024};
  full.errors = {"1e-3"};
  full.meshes = {"bunny3k", "torus"};
  StudyOptions quick = full;
  quick.cells = {32, 64, 128};
  quick.segments = 100'000;
  quick.pairs = 100;
  quick.measure.seconds = 0.01;
  return runStudy(argc, argv, "Queries over threads, points and cells", full, quick, studyAll);
}
