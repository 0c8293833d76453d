#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

#include "commands.h"
#include "common/files/checked_file.h"
#include "common/number_text.h"
#include "lost_walls.h"
#include "mesh_field.h"
#include "output_file.h"
#include "print.h"
#include "resolution_options.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "shell/point_shell.h"
#include "slice.h"
#include "solid/openings/openings.h"
#include "time_option.h"

namespace sdf_ccd::tools {
namespace {

struct InfoArguments {
  std::string file;
  std::string slice;
  std::string out;
  ResolutionOptions resolution;
  TimeOption time;
};

std::string wallsText(const DistanceField& field, const std::optional<LostSurface>& lost) {
  if (!lost) return "not examined";
  if (isNoticed(*lost)) return describeLost(*lost, field);
  return "all kept (" + shortText(100.0 * lost->share) + " % of the surface lost)";
}

void printField(const DistanceField& field, const std::optional<LostSurface>& lost) {
  std::cout << "field: " << describe(field) << "\nsurface within " << describe(field.surfaceBox())
            << "\nsamples within " << describe(field.box()) << "\nopenings: " << describeOpenings(field)
            << "\nthin walls: " << wallsText(field, lost) << std::endl;
}

void printShell(const PointShell& shell) {
  AlignedBox3d box;
  double area = 0.0;
  for (const Vector3d& p : shell.points()) box.extend(p);
  for (const double a : shell.areas) area += a;
  std::cout << "shell: " << describe(shell) << ", area " << shortText(area) << " m^2\n";
  if (shell.size() > 0) std::cout << "within " << describe(box) << std::endl;
}

void printQuality(const MeshQuality& quality) {
  std::cout << "mesh: " << summary(quality) << "\n"
            << "triangles            " << quality.triangles << "\n"
            << "without area         " << quality.degenerate_triangles << "\n"
            << "components           " << quality.components << "\n"
            << "inverted components  " << quality.inverted_components + quality.inverted_sheets << ", "
            << quality.inverted_sheets << " of them open\n"
            << "negative triangles   " << quality.negative_triangles << "\n"
            << "duplicates left out  " << quality.duplicate_triangles << ", " << shortText(quality.duplicate_area)
            << " m^2\n"
            << "walls left out       " << quality.hidden_triangles << ", " << shortText(quality.hidden_area) << " m^2\n"
            << "walls kept           " << quality.wall_triangles << "\n"
            << "boundary edges       " << quality.boundary_edges << "\n"
            << "non-manifold edges   " << quality.non_manifold_edges << "\n"
            << "misoriented edges    " << quality.misoriented_edges << "\n"
            << "volume               " << shortText(quality.volume) << " m^3\n"
            << "area                 " << shortText(quality.area) << " m^2\n"
            << "box                  " << describe(quality.box) << "\n"
            << "sign trusted         " << (quality.sign_trusted ? "yes" : "no") << std::endl;
}

/// Prints a summary of the file; returns its field if a slice is requested.
std::optional<DistanceField> inspect(const InfoArguments& arguments) {
  const std::string& file = arguments.file;
  const bool wants_field = !arguments.slice.empty();
  if (!wants_field) arguments.resolution.requireNone("a field is built only with --slice");
  if (isFieldFile(file)) {
    arguments.resolution.requireNone(file + " is a field already");
    const DistanceField field = loadField(file);
    printField(field, loadLostSurface(file));
    return field;
  }
  if (isCheckedFile(file, "shell")) {
    printShell(loadShell(file));
    return std::nullopt;
  }
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".bt" || ending == ".ot") {
    double voxel_size = 0.0;
    const TriangleMesh mesh = loadOctomapSurface(file, voxel_size);
    std::cout << "OctoMap: voxels of " << voxel_size << " m; the surface of the occupied ones has "
              << mesh.triangles.size() << " triangles, volume " << shortText(signedVolume(mesh)) << " m^3\nwithin "
              << describe(boundingBox(mesh)) << std::endl;
    if (!wants_field) return std::nullopt;
    MadeSolid made;
    made.may_be_voxels = true;
    return buildFileField(file, mesh, made, arguments.resolution.fieldOptions(voxel_size / 2.0), ThinWalls::kReport);
  }
  const OrientedMesh oriented = orientWithWarning(file, loadMesh(file));
  printQuality(oriented.quality);
  std::cout << "openings             " << summary(findOpenings(oriented.mesh)) << std::endl;
  MadeSolid made;
  printSolid(SolidSource(oriented.mesh, made).solid().report(), "solid: ");
  if (!wants_field) return std::nullopt;
  return buildFileField(file, oriented.mesh, made, arguments.resolution.fieldOptions(),
                        arguments.resolution.thinWalls());
}

void run(const InfoArguments& arguments) {
  if (arguments.slice.empty() != arguments.out.empty()) throw std::runtime_error("--slice and --out go together");
  if (arguments.slice.empty()) {
    arguments.time.limit([&] { inspect(arguments); });
    return;
  }
  const Slice slice = parseSlice(arguments.slice);
  OutputFile out(arguments.out);
  const std::optional<DistanceField> field = arguments.time.limit([&] { return inspect(arguments); });
  if (!field) throw std::runtime_error(arguments.file + ": a shell cannot be sliced");
  out.stream() << drawSlice(*field, slice);
  out.commit();
}

}  // namespace

void addInfoCommand(CLI::App& app) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = app.add_subcommand("info", "What a field, shell, mesh or OctoMap file holds");
  command->add_option("file", arguments->file, "File to look into")->required();
  command->add_option("--slice", arguments->slice,
                      "Plane to draw, such as z=0.1 [m]; for a mesh, a field is built first");
  command->add_option(
      "--out", arguments->out,
      "PNG file for the slice: the surface black, orange where it is a cap over an opening of the mesh");
  arguments->resolution.addTo(*command);
  arguments->time.addTo(*command);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
