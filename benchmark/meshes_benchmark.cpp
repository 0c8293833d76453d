// Defects of meshes found in practice, expected and measured cost of building their fields, and false crossings that
// these fields report. Prints rows of results.csv.
#include <ctime>
#include <memory>
#include <stdexcept>

#include "embree_scene.h"
#include "field/build_field.h"
#include "results.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "segment_cases.h"
#include "solid/closed_solid.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

/// CPU time of all threads of this process, which other load disturbs less than wall-clock time.
double processorSeconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/// Numbers of intervals that a field reports on segments across its box, and of those whose midpoint is not inside the
/// mesh.
struct Crossings {
  std::size_t reported = 0, untrue = 0;
};

Crossings countCrossings(const DistanceField& field, const EmbreeScene& mesh, const AlignedBox3d& box) {
  constexpr int kSegments = 20'000;
  test::Random random(20140924);
  // All segments start and end outside.
  const double radius = 0.75 * box.diagonal().norm();
  Crossings crossings;
  for (int i = 0; i < kSegments; ++i) {
    const Vector3d towards = test::uniformIn(random, box), way = test::direction(random);
    const double middle = way.dot(box.center() - towards);
    const Segment segment{towards + (middle - radius) * way, towards + (middle + radius) * way};
    for (const Interval& interval : segmentIntervals(field, segment)) {
      const double t = 0.5 * (interval.enter + interval.exit);
      ++crossings.reported;
      crossings.untrue += mesh.windingNumber({segment.start + t * (segment.end - segment.start), segment.end}) == 0;
    }
  }
  return crossings;
}

class Rows {
 public:
  explicit Rows(std::string name) : name_(std::move(name)) {}
  void add(const std::string& metric, double value, const char* unit) const {
    print({"meshes", name_, "sdf_ccd", metric, value, unit, 1});
  }

 private:
  std::string name_;
};

void addQuality(const MeshQuality& quality, const Rows& rows) {
  rows.add("degenerate", quality.degenerate_triangles, "");
  rows.add("duplicates", quality.duplicate_triangles, "");
  rows.add("walls_dropped", quality.hidden_triangles, "");
  rows.add("walls_kept", quality.wall_triangles, "");
  rows.add("dropped_area", quality.duplicate_area + quality.hidden_area, "m^2");
  rows.add("components", quality.components, "");
  rows.add("turned_closed", quality.inverted_components, "");
  rows.add("turned_open", quality.inverted_sheets, "");
  rows.add("negative", quality.negative_triangles, "");
  rows.add("boundary_edges", quality.boundary_edges, "");
  rows.add("non_manifold_edges", quality.non_manifold_edges, "");
  rows.add("trusted", quality.sign_trusted, "");
}

void addSolid(const SolidReport& report, const Rows& rows) {
  rows.add("buried", report.dropped, "");
  rows.add("clipped", report.clipped, "");
  rows.add("doubtful", report.doubtful, "");
}

void study(const std::string& name, const TriangleMesh& mesh, const StudyOptions& options) {
  const Rows rows(name);
  rows.add("triangles", double(mesh.triangles.size()), "");
  double start = processorSeconds();
  const OrientedMesh oriented = orientOutward(mesh);
  rows.add("orient_seconds", processorSeconds() - start, "s");
  addQuality(oriented.quality, rows);
  start = processorSeconds();
  const auto solid = std::make_shared<const Solid>(oriented.mesh);
  rows.add("solid_seconds", processorSeconds() - start, "s");
  addSolid(solid->report(), rows);
  start = processorSeconds();
  const ClosedSolid closed(solid);
  rows.add("closing_seconds", processorSeconds() - start, "s");
  const AlignedBox3d box = boundingBox(oriented.mesh);
  const EmbreeScene embree(oriented.mesh);
  for (const std::string& error : options.errors) {
    FieldOptions field;
    field.max_error = std::stod(error) * box.sizes().maxCoeff();
    start = processorSeconds();
    const DistanceField built = buildField(closed, field);
    rows.add("build_seconds_" + error, processorSeconds() - start, "s");
    rows.add("cells_" + error, double(built.cells()), "");
    rows.add("megabytes_" + error, 1e-6 * double(built.bytes()), "MB");
    if (!isClosed(oriented.mesh)) continue;
    const Crossings crossings = countCrossings(built, embree, box);
    rows.add("crossings_" + error, double(crossings.reported), "");
    rows.add("untrue_share_" + error, double(crossings.untrue) / double(crossings.reported), "1");
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd;
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.errors = {"1e-3"};
  return runStudy(argc, argv, "Quality of meshes, and time to build their fields", full, full,
                  [](const StudyOptions& options) {
                    for (const std::string& argument : options.mesh_files) {
                      const std::size_t equals = argument.find('=');
                      if (equals == std::string::npos) {
                        throw std::invalid_argument("--mesh " + argument + ": NAME=FILE is wanted");
                      }
                      const std::string name = argument.substr(0, equals);
                      if (isWanted(options.meshes, name)) study(name, loadMesh(argument.substr(equals + 1)), options);
                    }
                  });
}
