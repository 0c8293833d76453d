#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "commands.h"
#include "mesh_build.h"
#include "prepare_robot.h"
#include "resolution_options.h"
#include "sdf_ccd/mesh.h"
#include "threads_option.h"
#include "time_option.h"
#ifdef SDF_CCD_WITH_ROS
#include "tools/ros/monitor_scene.h"
#endif

namespace sdf_ccd::tools {
namespace {

struct BuildArguments {
  std::string urdf;
  std::string srdf;
  std::string mesh;
  std::string octomap;
  std::string out;
  ResolutionOptions resolution;
  std::optional<double> spacing;
  std::string config;
  ThreadsOption threads;
  TimeOption time;
};

#ifdef SDF_CCD_WITH_ROS
void prepareWithParameters(const BuildArguments& arguments) {
  if (arguments.urdf.empty()) throw std::runtime_error("--config needs --urdf");
  if (arguments.spacing) throw std::runtime_error("--spacing: with --config, shell/spacing of that file counts");
  arguments.resolution.requireNone("with --config, the resolution comes from that file");
  prepareMonitored({arguments.urdf, arguments.srdf, arguments.config, {}, {}}, arguments.out);
}
#endif

void buildFile(const BuildArguments& arguments) {
  MeshBuild build;
  const bool is_mesh = !arguments.mesh.empty();
  const std::string& file = is_mesh ? arguments.mesh : arguments.octomap;
  build.name = std::filesystem::path(file).stem().string();
  build.mesh = is_mesh ? loadMesh(file) : loadOctomapSurface(file, build.voxel_size);
  // Half a voxel: the field's error, √3/2 of a cell, is then less than the depth of a voxel's centre, so that no voxel
  // is lost.
  build.field = is_mesh ? arguments.resolution.fieldOptions() : arguments.resolution.fieldOptions(build.voxel_size / 2);
  if (is_mesh) build.thin_walls = arguments.resolution.thinWalls();
  build.spacing = arguments.spacing;
  std::cout << build.name << ": " << file << "\n";
  arguments.time.limit([&] { buildMesh(std::move(build), arguments.out); });
}

void run(const BuildArguments& arguments) {
  if (!arguments.srdf.empty() && arguments.urdf.empty()) throw std::runtime_error("--srdf needs --urdf");
  if (arguments.spacing && !(*arguments.spacing > 0.0)) throw std::runtime_error("--spacing must be positive");
  arguments.resolution.fieldOptions();  // rejects bad values before anything is read
  const auto limit = arguments.threads.limit();
#ifdef SDF_CCD_WITH_ROS
  if (!arguments.config.empty()) return prepareWithParameters(arguments);
#endif
  if (arguments.urdf.empty()) return buildFile(arguments);
  prepareRobot(
      {arguments.urdf, arguments.srdf, arguments.resolution.given(), arguments.spacing, arguments.time.seconds},
      arguments.out);
}

}  // namespace

void addBuildCommand(CLI::App& app) {
  auto arguments = std::make_shared<BuildArguments>();
  CLI::App* command = app.add_subcommand("build", "Make fields and shells, and report on the meshes");
  command->footer(
      "For a robot, builds what the monitor builds at start-up: load it with the parameter cache_directory: DIR, or a "
      "copy of DIR. Files are named by their content; the last line says which parameters load them. For a mesh or an "
      "OctoMap, writes NAME.field and NAME.shell in the mesh's frame, NAME the file's. package:// is looked up in "
      "ROS_PACKAGE_PATH.");
  auto* source = command->add_option_group("source");
  source->add_option("--urdf", arguments->urdf, "Robot; its links' collision meshes are taken");
  source->add_option("--mesh", arguments->mesh, "Mesh file: STL, DAE, OBJ, OFF, PLY, ...");
  source->add_option("--octomap", arguments->octomap, "World: .bt or .ot file; the default cell is half a voxel");
  source->require_option(1);
  command->add_option("--srdf", arguments->srdf, "With --urdf: pairs that need no check");
  command->add_option("--out", arguments->out, "Directory to write to; made if it is missing")->required();
  arguments->resolution.addTo(*command);
  command->add_option(
      "--spacing", arguments->spacing,
      "Maximum distance from a surface to a shell point [m]; default two cells, for a robot as the monitor's");
#ifdef SDF_CCD_WITH_ROS
  command->add_option(
      "--config", arguments->config,
      "With --urdf: the monitor's parameters, as config/monitor.yaml, instead of default ones. The world's bodies are "
      "built, too");
#endif
  arguments->threads.addTo(*command);
  arguments->time.addTo(*command);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
