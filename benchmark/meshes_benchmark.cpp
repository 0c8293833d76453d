// What is found in meshes as people draw them, and what building their fields costs. Prints rows of results.csv.
#include <chrono>
#include <stdexcept>

#include "results.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/geometry/mesh_file.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "study.h"

namespace sdf_ccd::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void study(const std::string& name, const TriangleMesh& mesh, const StudyOptions& options) {
  const auto row = [&](const std::string& metric, double value, const char* unit) {
    print({"meshes", name, "sdf_ccd", metric, value, unit, 1});
  };
  auto start = Clock::now();
  const OrientedMesh oriented = orientOutward(mesh);
  row("orient_seconds", secondsSince(start), "s");
  const MeshQuality& quality = oriented.quality;
  row("triangles", double(mesh.triangles.size()), "");
  row("degenerate", quality.degenerate_triangles, "");
  row("duplicates", quality.duplicate_triangles, "");
  row("walls_dropped", quality.hidden_triangles, "");
  row("walls_kept", quality.wall_triangles, "");
  row("dropped_area", quality.duplicate_area + quality.hidden_area, "m^2");
  row("components", quality.components, "");
  row("turned_closed", quality.inverted_components, "");
  row("turned_open", quality.inverted_sheets, "");
  row("negative", quality.negative_triangles, "");
  row("boundary_edges", quality.boundary_edges, "");
  row("non_manifold_edges", quality.non_manifold_edges, "");
  row("trusted", quality.sign_trusted, "");
  for (const std::string& error : options.errors) {
    FieldOptions field;
    field.max_error = std::stod(error) * boundingBox(oriented.mesh).sizes().maxCoeff();
    start = Clock::now();
    const DistanceField built = buildField(oriented.mesh, field);
    row("build_seconds_" + error, secondsSince(start), "s");
    row("cells_" + error, double(built.cells()), "");
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
