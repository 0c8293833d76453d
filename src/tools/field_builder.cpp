#include "field_builder.h"

#include <chrono>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "common/seconds_since.h"
#include "field/source_field.h"
#include "print.h"
#include "progress_bar.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/shell/point_shell.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::tools {
namespace {

std::string secondsText(double seconds) {
  return rounded(seconds, 2) + " s";
}

void warnOf(const MeshQuality& quality, const std::string& source) {
  const std::string warning = warningOf(quality);
  if (!warning.empty()) std::cerr << "sdf_ccd: " << source << ": " << warning << std::endl;
}

DistanceField buildWithBar(const std::string& title, const SolidSource& source, const FieldOptions& options) {
  ProgressBar bar(title);
  return buildField(source, options, [&](double share) { bar(share); });
}

}  // namespace

OrientedMesh orientWithWarning(const std::string& source, const TriangleMesh& mesh) {
  OrientedMesh oriented = orientOutward(mesh);
  warnOf(oriented.quality, source);
  return oriented;
}

void printSolid(const SolidReport& report, const std::string& indent) {
  const std::string found = summary(report), doubt = warning(report);
  if (!found.empty()) std::cout << indent << found << "\n";
  if (!doubt.empty()) std::cout << indent << "warning: " << doubt << "\n";
}

DistanceField buildAffordable(const std::string& file, const TriangleMesh& mesh, MadeSolid& made,
                              const FieldOptions& options) {
  BuildCost cost({});
  cost.addField(file, mesh, made, options);
  cost.announce();
  return buildWithBar("field", SolidSource(mesh, made), options);
}

PooledMesh& FieldBuilder::find(const std::shared_ptr<const TriangleMesh>& mesh, bool voxels) {
  return pool_.find({mesh, Isometry3d::Identity(), {}, voxels});
}

void FieldBuilder::expectMesh(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh) {
  try {
    const auto start = std::chrono::steady_clock::now();
    PooledMesh& pooled = find(mesh, false);
    if (!expected_.insert(&pooled).second) return;
    cost_.add(name, pooled, resolution_.fieldOptions());
    seconds_ += secondsSince(start);
  } catch (const std::exception&) {
    // addMesh() reports the error.
  }
}

void FieldBuilder::expectVoxels(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh,
                                double voxel_size) {
  const auto start = std::chrono::steady_clock::now();
  cost_.add(name, find(mesh, true), resolution_.fieldOptions(voxel_size / 2.0));
  seconds_ += secondsSince(start);
}

FieldBuilder::Made FieldBuilder::make(const std::string& name, PooledMesh& mesh) {
  warnOf(mesh.quality, name);
  const auto start = std::chrono::steady_clock::now();
  const SolidSource source(mesh.mesh, mesh.made);
  const Solid& solid = source.solid();
  DistanceField field = buildWithBar("field of " + name, source, resolution_.fieldOptions());
  const double field_seconds = secondsSince(start);
  ShellOptions options;
  options.spacing = spacing_.value_or(shellSpacing(field.errorBound()));
  PointShell shell = sampleSurface(solid, options);
  Made made{field,          std::move(shell), summary(mesh.quality),
            solid.report(), field_seconds,    secondsSince(start) - field_seconds};
  mesh.made = {};
  return made;
}

void FieldBuilder::addMesh(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh) {
  PooledMesh& pooled = find(mesh, false);
  auto found = made_.find(&pooled);
  const bool is_new = found == made_.end();
  if (is_new) {
    found = made_.emplace(&pooled, make(name, pooled)).first;
    seconds_ += found->second.field_seconds + found->second.shell_seconds;
  }
  const Made& made = found->second;
  std::cout << "  mesh   " << made.quality << "\n";
  printSolid(made.solid, "  solid  ");
  writeField(name, made.field, is_new ? secondsText(made.field_seconds) : "built above");
  writeShell(name, made.shell, is_new ? secondsText(made.shell_seconds) : "built above");
}

void FieldBuilder::addVoxels(const std::string& name, const std::shared_ptr<const TriangleMesh>& mesh,
                             double voxel_size) {
  std::cout << "  voxels " << voxel_size << " m, " << mesh->triangles.size() << " triangles, volume "
            << signedVolume(*mesh) << " m^3\n";
  const auto start = std::chrono::steady_clock::now();
  PooledMesh& pooled = find(mesh, true);
  const DistanceField field = buildWithBar("field of " + name, SolidSource(pooled.mesh, pooled.made),
                                           resolution_.fieldOptions(voxel_size / 2.0));
  seconds_ += secondsSince(start);
  writeField(name, field, secondsText(secondsSince(start)));
}

void FieldBuilder::writeField(const std::string& name, const DistanceField& field, const std::string& time) {
  const std::string file = name + ".field";
  saveField(field, out_.file(file));
  std::cout << "  field  " << file << ": " << describe(field) << ", " << time << std::endl;
  ++fields_;
  field_bytes_ += field.bytes();
}

void FieldBuilder::writeShell(const std::string& name, const PointShell& shell, const std::string& time) {
  const std::string file = name + ".shell";
  saveShell(shell, out_.file(file));
  std::cout << "  shell  " << file << ": " << describe(shell) << ", " << time << std::endl;
  ++shells_;
  shell_points_ += shell.size();
}

void FieldBuilder::printTotals() const {
  std::cout << fields_ << " fields, " << megabytes(field_bytes_) << "; " << shells_ << " shells, " << shell_points_
            << " points; " << secondsText(seconds_) << std::endl;
}

}  // namespace sdf_ccd::tools
