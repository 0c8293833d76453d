/// Error against run time: the studies of `sdf_ccd work-precision`, with other libraries for comparison. Prints rows of
/// results.csv and draws the studies' plots.

#include <cmath>

#include "build_systems.h"
#include "common/number_text.h"
#include "precision/gnuplot.h"
#include "precision/report.h"
#include "precision/studies.h"
#include "segment_system.h"
#include "study.h"
#ifdef SDF_CCD_WITH_FCL
#include "impact_study.h"
#endif

namespace sdf_ccd::benchmark {
namespace {

constexpr double kSide = 0.2;  ///< longest side of every mesh [m]

using precision::Measurement;
using precision::StudyResult;

precision::Label gridLabel(const std::string& system, const TriangleMesh& mesh, int cells) {
  const double cell = boundingBox(mesh).sizes().maxCoeff() / cells;
  return {system, lengthText(cell), cell};
}

void addHits(SegmentSystems systems, const std::vector<Segment>& segments,
             const std::function<precision::Label(const std::string&)>& label, precision::FieldSystems& all) {
  for (auto& system : systems) {
    if (!system->tellsTimes()) continue;
    const std::shared_ptr<SegmentSystem> shared = std::move(system);
    all.hits.push_back({label(shared->name()),
                        [shared, &segments](std::vector<double>& times) { shared->firstTimes(segments, times); }});
  }
}

void addPeers(const precision::FieldQueries& queries, int cells, precision::FieldSystems& all) {
  SegmentSystems systems;
  if (cells == 0) {
    for (const MeshFactory& factory : meshFactories()) factory(queries.mesh, systems);
    return addHits(
        std::move(systems), queries.segments,
        [](const std::string& name) {
          return precision::Label{name, ""};
        },
        all);
  }
  const DistanceField none{Primitive(Sphere{1.0})};  // unused: these systems make their own grids
  for (const FieldFactory& factory : fieldFactories()) factory({queries.mesh, none, cells, false}, systems);
  addHits(
      std::move(systems), queries.segments,
      [&](const std::string& name) { return gridLabel(name, queries.mesh, cells); }, all);
  for (const FieldBuilder& builder : fieldBuilders()) {
    const std::shared_ptr<const BuiltField> field = builder.build(queries.mesh, {builder.name, cells, {}});
    all.distances.push_back(
        {gridLabel(builder.name, queries.mesh, cells), [field, &queries](std::vector<double>& found) {
           for (std::size_t i = 0; i < queries.points.size(); ++i) found[i] = field->distance(queries.points[i]);
         }});
  }
}

void printRows(const std::string& mesh, const StudyResult& result) {
  for (const Measurement& row : result.rows) {
    const std::string name = mesh + "/" + result.study + "/" + row.quantity + "/" + row.setting;
    const int queries = int(row.error.count + row.missed);
    const auto print_one = [&](const char* metric, double value, const std::string& unit) {
      print({"work-precision", name, row.system, metric, value, unit, queries});
    };
    print_one("us_per_query", 1e6 * row.seconds, "us");
    print_one("error_median", row.error.median, row.unit);
    print_one("error_p99", row.error.p99, row.unit);
    print_one("error_max", row.error.max, row.unit);
    print_one("missed", double(row.missed), "queries");
    if (!std::isnan(row.bound)) print_one("bound", row.bound, row.unit);
  }
}

void draw(const StudyResult& result, const std::string& mesh, const std::string& directory) {
  precision::runGnuplot(precision::plotScript(result, directory + "/" + mesh + "_" + result.study + ".svg"));
}

/// Joins studies into one plot. A system without settings is in those of both kinds of fields, and added only once.
void addTo(StudyResult& joined, const StudyResult& result) {
  const bool first = joined.rows.empty();
  for (const Measurement& row : result.rows) {
    if (first || !row.setting.empty()) joined.rows.push_back(row);
  }
}

/// The tool's studies, and those that need other libraries for the exact values.
std::vector<precision::Study> allStudies() {
  std::vector<precision::Study> studies = precision::studies();
#ifdef SDF_CCD_WITH_FCL
  studies.push_back({"impact", "time of impact of two bodies in a monitor's cycle", &impactStudy});
#endif
  return studies;
}

void study(const NamedMesh& named, const StudyOptions& options) {
  precision::StudyInput input;
  // Scaled to the size of a robot link, so that the results of different meshes can be compared.
  input.mesh = scaled(named.mesh, Vector3d::Constant(kSide / boundingBox(named.mesh).sizes().maxCoeff()));
  input.queries = int(options.segments);
  input.quick = options.quick;
  input.add_peers = &addPeers;
  StudyResult joined{"fields", "Error against the exact mesh over run time: " + named.name, "", "query", {}};
  for (const precision::Study& study : allStudies()) {
    if (!isWanted(options.cases, study.name)) continue;
    const StudyResult result = study.run(input);
    printRows(named.name, result);
    if (isWanted({"cell", "max-error", "impact"}, result.study)) addTo(joined, result);
    if (!options.plots.empty()) draw(result, named.name, options.plots);
  }
  if (!options.plots.empty() && !joined.rows.empty()) draw(joined, named.name, options.plots);
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.segments = 2000;
  full.meshes = {"bunny3k", "link", "torus"};
  StudyOptions quick = full;
  quick.segments = 1000;
  quick.meshes = {"bunny3k", "torus"};
  return runStudy(argc, argv, "Error against run time, with other libraries beside", full, quick,
                  [](const StudyOptions& options) {
                    for (const NamedMesh& named : studyMeshes(options)) study(named, options);
                  });
}
