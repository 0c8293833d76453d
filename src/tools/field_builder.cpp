#include "field_builder.h"

#include <chrono>
#include <iostream>

#include "print.h"
#include "progress_bar.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/field/field_file.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/shell/sample_surface.h"
#include "sdf_ccd/shell/shell_file.h"

namespace sdf_ccd::tools {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

void FieldBuilder::addMesh(const std::string& name, const TriangleMesh& mesh) {
  const OrientedMesh oriented = orientOutward(mesh);
  std::cout << "  mesh   " << summary(oriented.quality) << "\n";
  const double cell = writeField(name, oriented.mesh, std::nullopt);
  writeShell(name, oriented.mesh, spacing_.value_or(2.0 * cell));
}

void FieldBuilder::addVoxels(const std::string& name, const TriangleMesh& mesh, double voxel_size) {
  std::cout << "  voxels " << voxel_size << " m, " << mesh.triangles.size() << " triangles, volume "
            << signedVolume(mesh) << " m³\n";
  writeField(name, mesh, voxel_size);
}

double FieldBuilder::writeField(const std::string& name, const TriangleMesh& mesh, std::optional<double> default_cell) {
  const auto start = std::chrono::steady_clock::now();
  const DistanceField field = [&] {
    ProgressBar bar("field of " + name);
    return buildField(mesh, resolution_.fieldOptions(default_cell), [&](double share) { bar(share); });
  }();
  const std::string file = name + ".field";
  saveField(field, out_.file(file));
  const double seconds = secondsSince(start);
  std::cout << "  field  " << file << ": " << describe(field) << ", " << rounded(seconds, 2) << " s" << std::endl;
  ++fields_;
  field_bytes_ += field.bytes();
  seconds_ += seconds;
  return field.grid()->shape().cell;
}

void FieldBuilder::writeShell(const std::string& name, const TriangleMesh& mesh, double spacing) {
  const auto start = std::chrono::steady_clock::now();
  ShellOptions options;
  options.spacing = spacing;
  const PointShell shell = sampleSurface(mesh, options);
  const std::string file = name + ".shell";
  saveShell(shell, out_.file(file));
  const double seconds = secondsSince(start);
  std::cout << "  shell  " << file << ": " << describe(shell) << ", " << rounded(seconds, 2) << " s" << std::endl;
  ++shells_;
  shell_points_ += shell.size();
  seconds_ += seconds;
}

void FieldBuilder::printTotals() const {
  std::cout << fields_ << " fields, " << megabytes(field_bytes_) << "; " << shells_ << " shells, " << shell_points_
            << " points; " << rounded(seconds_, 2) << " s" << std::endl;
}

}  // namespace sdf_ccd::tools
