/// Time and memory to build and load fields, and their error against the exact distance (paper, Table 1). Prints rows
/// of results.csv.

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "build_systems.h"
#include "mesh/triangle_tree.h"
#include "peak_memory.h"
#include "precision/error_summary.h"
#include "precision/random_inputs.h"
#include "segment_cases.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr std::size_t kPoints = 20'000;  ///< near the surface, and as many away from it, at which errors are measured

/// Points with their exact distances.
struct ExactPoints {
  std::vector<Vector3d> points;
  std::vector<double> distances;

  void add(const TriangleTree& tree, const Vector3d& p) {
    const double d = tree.closestPoint(p).distance;
    points.push_back(p);
    distances.push_back(tree.windingNumber(p) > 0.5 ? -d : d);
  }
};

/// Points within `reach` [m] of the surface.
ExactPoints pointsNear(const NamedMesh& named, const TriangleTree& tree, double reach) {
  test::Random random(1);
  ExactPoints exact;
  const precision::SurfaceSampler surface(named.mesh);
  while (exact.points.size() < kPoints) {
    const Vector3d p = surface(random);
    exact.add(tree, p + test::uniform(random, 0.0, reach) * test::direction(random));
  }
  return exact;
}

/// Points in the study's box that are farther from the surface than `reach` [m].
ExactPoints pointsAway(const NamedMesh& named, const TriangleTree& tree, double reach) {
  test::Random random(2);
  ExactPoints exact;
  while (exact.points.size() < kPoints) {
    const Vector3d p = test::uniformIn(random, studyBox(named.mesh));
    if (tree.closestPoint(p, reach).triangle < 0) exact.add(tree, p);
  }
  return exact;
}

void printErrors(Row row, const ExactPoints& exact, const BuiltField& field, double side) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < exact.points.size(); ++i) {
    errors.push_back(std::abs(field.distance(exact.points[i]) - exact.distances[i]) / side);
  }
  row.unit = "box side";
  row.runs = int(errors.size());
  const std::string place = row.metric;
  for (const auto& [name, share] : {std::pair{"_median", 0.5}, {"_p99", 0.99}, {"_max", 1.0}}) {
    row.metric = place + name;
    row.value = precision::quantile(errors, share);
    print(row);
  }
}

/// Number of builds that fit into 20 s, from 1 to options.measure.runs: large fields are built only a few times.
int runsFor(double seconds, const StudyOptions& options) {
  return std::clamp(int(20.0 / seconds), 1, options.measure.runs);
}

void study(const NamedMesh& named, const StudyField& wanted, const StudyOptions& options) {
  const double side = boundingBox(named.mesh).sizes().maxCoeff();
  std::vector<Task> builds, loads;
  std::vector<std::shared_ptr<const BuiltField>> fields;
  std::vector<std::string> names, paths;
  double slowest = 0.0;
  for (const FieldBuilder& builder : fieldBuilders()) {
    if (!builder.builds(wanted)) continue;
    const auto start = std::chrono::steady_clock::now();
    const std::size_t peak = peakMemory([&] { fields.push_back(builder.build(named.mesh, wanted)); });
    slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    print({"build", wanted.name, builder.name, "bytes", double(fields.back()->bytes), "B", 1});
    print({"build", wanted.name, builder.name, "peak_bytes", double(peak), "B", 1});
    builds.push_back({builder.name, [&](std::size_t) {
                        builder.build(named.mesh, wanted);
                        return std::size_t{1};
                      }});
    const std::string path = "/tmp/sdf_ccd_benchmark_" + std::to_string(getpid()) + "_" + builder.name;
    fields.back()->save(path);
    paths.push_back(path);
    const Vector3d corner = boundingBox(named.mesh).min();
    loads.push_back({builder.name, [&builder, path, corner](std::size_t) {
                       builder.load(path, corner);
                       return std::size_t{1};
                     }});
  }
  const auto timed = [&](const std::vector<Task>& tasks, const std::string& metric, bool all_threads) {
    MeasureOptions measured = options.measure;
    if (metric != "load_seconds") measured.runs = runsFor(slowest, options);
    measured.wall_clock = all_threads;
    const std::vector<Spread> spreads = measure(tasks, measured);
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      print({"build", wanted.name, tasks[k].system, metric, 0.0, "s", measured.runs}, spreads[k], 1.0);
    }
  };
  timed(builds, "seconds", false);
  timed(builds, "seconds_" + std::to_string(std::thread::hardware_concurrency()) + "_threads", true);
  timed(loads, "load_seconds", true);
  for (const std::string& path : paths) std::remove(path.c_str());

  // Within half of the narrowest band, every corner of a point's cell holds a sampled distance in all fields.
  double band = side;
  for (const auto& field : fields) band = std::min(band, field->band);
  const TriangleTree tree(named.mesh);
  const ExactPoints near = pointsNear(named, tree, 0.5 * band), away = pointsAway(named, tree, 2.0 * band);
  for (std::size_t k = 0; k < fields.size(); ++k) {
    printErrors({"build", wanted.name, builds[k].system, "error_near", 0.0, "", 1}, near, *fields[k], side);
    if (!fields[k]->beyond_band) continue;
    printErrors({"build", wanted.name, builds[k].system, "error_away", 0.0, "", 1}, away, *fields[k], side);
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.cells = {128, 256, 512, 1024};
  full.errors = {"1e-3", "2e-4", "1e-4"};
  full.meshes = {"bunny3k", "bunny75k", "link", "torus"};
  StudyOptions quick = full;
  quick.cells = {128};
  quick.errors = {"1e-3"};
  quick.meshes = {"bunny3k"};
  return runStudy(argc, argv, "Time, memory and error of fields", full, quick, [](const StudyOptions& options) {
    for (const NamedMesh& named : studyMeshes(options)) {
      for (const StudyField& wanted : studyFields(named, options)) {
        try {
          study(named, wanted, options);
        } catch (const std::length_error& error) {
          std::fprintf(stderr, "%s is left out: %s\n", wanted.name.c_str(), error.what());
        }
      }
    }
  });
}
