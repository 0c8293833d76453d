#include "mesh_build.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <utility>

#include "common/number_text.h"
#include "common/seconds_since.h"
#include "field/grid_cell.h"
#include "field/source_field.h"
#include "mesh_field.h"
#include "output_file.h"
#include "print.h"
#include "scene/body_options.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// @param field_error  error bound of the field [m].
ShellOptions shellOptions(const MeshBuild& build, double field_error) {
  ShellOptions options = shellForField(field_error);
  if (build.spacing) options.spacing = *build.spacing;
  return options;
}

/// The error bound of a field with these options, but for rounding [m].
double errorOf(const FieldOptions& options, const TriangleMesh& mesh) {
  if (options.max_error) return *options.max_error;
  if (options.cell_size) return kHalfSqrt3 * *options.cell_size;
  return kHalfSqrt3 * boundingBox(mesh).sizes().maxCoeff() / *options.cells;
}

/// @param start  when making it began.
template <class T>
void report(const std::string& what, const std::string& file, const T& made, Clock::time_point start) {
  std::cout << "  " << what << "  " << file << ": " << describe(made) << ", " << durationText(secondsSince(start))
            << std::endl;
}

}  // namespace

void buildMesh(MeshBuild build, const std::string& directory) {
  MadeSolid made;
  made.may_be_voxels = build.voxel_size > 0.0;
  if (made.may_be_voxels) {
    validate(build.mesh);
    std::cout << "  voxels " << build.voxel_size << " m, " << build.mesh.triangles.size() << " triangles, volume "
              << signedVolume(build.mesh) << " m^3\n";
  } else {
    OrientedMesh oriented = orientWithWarning(build.name, build.mesh);
    std::cout << "  mesh   " << summary(oriented.quality) << "\n";
    build.mesh = std::move(oriented.mesh);
  }
  const OutputDirectory out(directory);
  const SolidSource source(build.mesh, made);
  const auto start = Clock::now();
  const MeshField built = buildWithBar("field of " + build.name, source, build.field, build.thin_walls);
  const DistanceField& field = built.field;
  if (!made.may_be_voxels) printSolid(source.solid().report(), "  solid  ");
  warnOfLost(build.name, built);
  report("field", build.name + ".field", field, start);
  if (!made.may_be_voxels) {
    const auto field_end = Clock::now();
    // Cells that are small only because of thin walls need no more points.
    const double error = std::max(field.errorBound(), errorOf(build.field, build.mesh));
    const PointShell shell = sampleSurface(source.solid(), shellOptions(build, error));
    saveShell(shell, out.file(build.name + ".shell"));
    report("shell", build.name + ".shell", shell, field_end);
  }
  saveField(field, out.file(build.name + ".field"), {}, built.lost);
}

}  // namespace sdf_ccd::tools
