/// Time per segment query of this package, the paper's method and other libraries (paper, Table 2). Prints rows of
/// results.csv.

#include <cmath>

#include "measure.h"
#include "oracle/shapes.h"
#include "segment_cases.h"
#include "segment_system.h"
#include "study_fields.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr std::size_t kCounted = 20'000;  ///< segments whose results are counted, the same for every system

/// Segments per call of a system that is not batched, so that slow systems need not run all segments.
constexpr std::size_t kPiece = 2048;

const char* toString(Find find) {
  return find == Find::kFirst ? "first" : find == Find::kAll ? "all" : "any";
}

void compare(const std::string& row, const std::vector<SegmentSystem*>& systems, const std::vector<Segment>& segments,
             const Question& question, const StudyOptions& options) {
  std::vector<Task> tasks;
  std::vector<long> answers;
  const std::size_t counted = std::min(kCounted, segments.size());
  for (SegmentSystem* system : systems) {
    if (!system->answers(question)) continue;
    const std::size_t piece = std::min(system->batched() ? segments.size() : kPiece, segments.size());
    answers.push_back(system->run(segments.data(), counted, question));
    tasks.push_back({system->name(), [=, &segments](std::size_t i) {
                       const std::size_t pieces = segments.size() / piece;
                       system->run(segments.data() + i % pieces * piece, piece, question);
                       return piece;
                     }});
  }
  const std::vector<Spread> spreads = measure(tasks, options.measure);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    print({"segment", row, tasks[k].system, "ns_per_segment", 0.0, "ns", options.measure.runs}, spreads[k], 1e9);
    print({"segment", row, tasks[k].system, "crossings", double(answers[k]),
           "of " + std::to_string(counted) + " segments", 1});
  }
}

void studyField(const std::string& name, const FieldSubject& subject, const SegmentSystems& mesh_systems,
                const std::vector<SegmentCase>& cases, const StudyOptions& options) {
  SegmentSystems field_systems;
  for (const FieldFactory& factory : fieldFactories()) factory(subject, field_systems);
  std::vector<SegmentSystem*> systems;
  for (const auto& system : field_systems) systems.push_back(system.get());
  for (const auto& system : mesh_systems) systems.push_back(system.get());
  for (const SegmentSystem* system : systems) {
    if (system->bytes() == 0) continue;
    print({"segment", name, system->name(), "bytes", double(system->bytes()), "B", 1});
  }
  for (const SegmentCase& c : cases) {
    const std::string row = name + "/" + c.name + "/";
    for (const Find find : {Find::kFirst, Find::kAll, Find::kAny}) {
      compare(row + toString(find), systems, c.segments, {find, 0.0}, options);
    }
    if (c.name != "A") continue;
    // Half the band: an isovalue as in the queries of a shell's spheres.
    compare(row + "first_sigma", systems, c.segments, {Find::kFirst, 0.5 * subject.field.band()}, options);
    compare(row + "all_sigma", systems, c.segments, {Find::kAll, 0.5 * subject.field.band()}, options);
  }
}

void study(const NamedMesh& named, const StudyOptions& options) {
  std::vector<SegmentCase> cases;
  for (SegmentCase& c : segmentCases(named.mesh, options.segments)) {
    if (isWanted(options.cases, c.name)) cases.push_back(std::move(c));
  }
  SegmentSystems mesh_systems;
  for (const MeshFactory& factory : meshFactories()) factory(named.mesh, mesh_systems);
  const bool paper = isWanted(options.paper_meshes, named.name);
  for (const StudyField& wanted : studyFields(named, options)) {
    withField(named, wanted, [&](const DistanceField& field) {
      studyField(wanted.name, {named.mesh, field, wanted.cells, paper}, mesh_systems, cases, options);
    });
  }
}

/// Checks that every system finds the same number of crossings of a ball, so that none is fast because it is wrong.
/// @throws std::runtime_error naming a system that differs.
void checkSystems() {
  const TriangleMesh ball = test::icosphere(0.5, 5);
  FieldOptions field_options;
  field_options.cells = 128;
  const DistanceField field = buildField(ball, field_options);
  SegmentSystems systems;
  for (const MeshFactory& factory : meshFactories()) factory(ball, systems);
  for (const FieldFactory& factory : fieldFactories()) factory({ball, field, 128, true}, systems);
  const std::vector<Segment> segments = segmentCases(ball, 20'000).front().segments;
  const auto count = [&](const std::string& name, Find find) {
    for (const auto& system : systems) {
      if (system->name() == name) return system->run(segments.data(), segments.size(), {find, 0.0});
    }
    throw std::runtime_error("there is no system " + name);
  };
  const long crossings = count("sdf_ccd", Find::kAll);
  for (const auto& system : systems) {
    if (!system->answers({Find::kAll, 0.0})) continue;
    const long found = count(system->name(), Find::kAll);
    // Grazing segments may differ: facets and cells differ, and the paper's sign test loses some crossings.
    if (std::abs(double(found - crossings)) > 2e-3 * double(crossings)) {
      throw std::runtime_error(system->name() + " finds " + std::to_string(found) + " crossings of a ball, sdf_ccd " +
                               std::to_string(crossings));
    }
  }
  for (const Find find : {Find::kFirst, Find::kAll}) {
    if (count("paper_octree", find) != count("paper_uniform", find)) {
      throw std::runtime_error("the paper's octree and uniform traversals do not find the same on a ball");
    }
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.cells = {128, 256, 512, 1024};
  full.errors = {"1e-3", "2e-4", "1e-4"};
  StudyOptions quick = full;
  quick.cells = {128};
  quick.errors = {"1e-3"};
  quick.meshes = {"bunny3k"};
  quick.segments = 100'000;
  quick.measure.seconds = 0.01;
  return runStudy(argc, argv, "Time per segment query, over fields, meshes and systems", full, quick,
                  [](const StudyOptions& options) {
                    checkSystems();
                    for (const NamedMesh& mesh : studyMeshes(options)) study(mesh, options);
                  });
}
