/// Error of the first hits of random segments on the interpolated field, against exact hits on the mesh (Embree,
/// robust), over the cell size. Prints rows of results.csv.

#include <cmath>

#include "embree_scene.h"
#include "oracle/random.h"
#include "precision/error_summary.h"
#include "results.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using precision::quantile;

void study(const std::string& name, const TriangleMesh& mesh, const StudyOptions& study_options) {
  const EmbreeScene rays(mesh);
  AlignedBox3d box = boundingBox(mesh);
  const double side = box.sizes().maxCoeff();
  box = {box.min().array() - 0.2 * side, box.max().array() + 0.2 * side};
  double last_median = 0.0;
  int last_cells = 0;
  for (const int cells : study_options.cells) {
    FieldOptions options;
    options.cells = cells;
    const DistanceField field = buildField(mesh, options);
    test::Random random(1);
    std::vector<double> errors, distances;
    int only_mesh = 0, only_field = 0;
    for (std::size_t i = 0; i < study_options.segments; ++i) {
      Segment s{test::uniformIn(random, box), test::uniformIn(random, box)};
      // Only segments that start outside can be compared: inside, the field's interval begins at 0.
      if (field.sample(s.start).value <= field.errorBound()) continue;
      const double exact = rays.firstHit(s);
      const Intervals found = segmentIntervals(field, s, {0.0, SegmentMode::kFirst});
      only_mesh += exact >= 0.0 && found.empty();
      only_field += exact < 0.0 && !found.empty();
      if (exact < 0.0 || found.empty()) continue;
      errors.push_back(std::abs(found[0].enter - exact) * (s.end - s.start).norm());
      // The error without the effect of the angle of incidence: distance of the exact hit from the field's isosurface.
      distances.push_back(std::abs(field.sample(s.start + exact * (s.end - s.start)).value));
    }
    if (errors.empty()) throw std::runtime_error(name + ": no segment hits both the mesh and its field");
    const std::string row = name + "/" + std::to_string(cells);
    const auto add = [&](const std::string& metric, double value, const std::string& unit) {
      print({"accuracy", row, "sdf_ccd", metric, value, unit, int(errors.size())});
    };
    const double median = quantile(distances, 0.5) / side;
    add("hit_distance_median", quantile(errors, 0.5) / side, "box side");
    add("hit_distance_p99", quantile(errors, 0.99) / side, "box side");
    add("surface_error_median", median, "box side");
    add("surface_error_p99", quantile(distances, 0.99) / side, "box side");
    add("surface_error_max", quantile(distances, 1.0) / side, "box side");
    add("bound", field.errorBound() / side, "box side");
    add("hits_of_mesh_only", only_mesh, "segments");
    add("hits_of_field_only", only_field, "segments");
    if (last_cells > 0) add("order", std::log(last_median / median) / std::log(double(cells) / last_cells), "1");
    last_median = median;
    last_cells = cells;
  }
}

}  // namespace
}  // namespace sdf_ccd::benchmark

int main(int argc, char** argv) {
  using namespace sdf_ccd::benchmark;
  StudyOptions full;
  full.cells = {32, 64, 128, 256, 512};
  full.segments = 20'000;
  StudyOptions quick = full;
  quick.cells = {32, 64, 128};
  quick.meshes = {"bunny3k"};
  return runStudy(argc, argv, "Error of segment queries against exact mesh hits, over the cell size", full, quick,
                  [](const StudyOptions& options) {
                    for (const NamedMesh& named : studyMeshes(options)) study(named.name, named.mesh, options);
                  });
}
