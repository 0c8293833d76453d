#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "commands.h"
#include "field_builder.h"
#include "read_text.h"
#include "sdf_ccd/import/mesh_file.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/robot/robot_scene.h"
#include "threads_option.h"
#ifdef SDF_CCD_WITH_ROS
#include "tools/ros/prepare_robot.h"
#endif

namespace sdf_ccd::tools {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string urdf;
  std::string srdf;
  std::string mesh;
  std::string octomap;
  std::string out;
  ResolutionOptions resolution;
  std::optional<double> spacing;
  std::string config;
  ThreadsOption threads;
};

std::string stemOf(const std::string& path) {
  return fs::path(path).stem().string();
}

/// Assigns a unique file name to each mesh of each link. Links whose names differ only by a slash, or by a number at
/// their end, would otherwise share a file.
class FileNames {
 public:
  explicit FileNames(const std::vector<BodyDescription>& bodies) {
    for (const BodyDescription& body : bodies) links_.insert(asFileName(body.name));
  }

  /// NAME for a link's first mesh, NAME_2 and so on for the others; names in use are skipped.
  std::string next(const std::string& link, bool first) {
    const std::string name = asFileName(link);
    if (first && used_.insert(name).second) return name;
    for (int number = 2;; ++number) {
      const std::string numbered = name + "_" + std::to_string(number);
      if (!links_.count(numbered) && used_.insert(numbered).second) return numbered;
    }
  }

 private:
  static std::string asFileName(std::string name) {
    std::replace(name.begin(), name.end(), '/', '_');
    return name;
  }

  std::set<std::string> links_;
  std::set<std::string> used_;
};

struct Robot {
  SceneDescription scene;
  std::size_t pairs = 0;
};

Robot loadRobot(const Arguments& arguments) {
  const std::string directory = fs::absolute(arguments.urdf).parent_path().string();
  const PackageFinder packages = packagesFromEnvironment();
  const ResourceLoader loader = [&](const std::string& uri) { return loadLocalResource(uri, packages, directory); };
  const RobotModel model(readText(arguments.urdf), arguments.urdf);
  const Srdf srdf = arguments.srdf.empty() ? Srdf() : parseSrdf(readText(arguments.srdf), arguments.srdf);
  std::vector<std::string> warnings;
  Robot robot;
  robot.scene = describeRobot(model, srdf, loader, {}, warnings);
  robot.pairs = planScene(robot.scene).pairs.size();
  for (const std::string& warning : warnings) std::cerr << "sdf_ccd: " << warning << std::endl;
  return robot;
}

/// Builds the fields and shells of one link's meshes.
/// @return false, after a line on stderr, if one of them cannot be built.
bool buildLink(const BodyDescription& body, FileNames& names, FieldBuilder& builder) {
  try {
    if (!body.failure.empty()) throw std::runtime_error(body.failure);
    bool is_first = true;
    for (const GeometryDescription& element : body.geometry) {
      std::cout << body.name << ": " << element.source << "\n";
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&element.shape);
      if (!mesh) {
        std::cout << "  exact, needs no file\n";
        continue;
      }
      builder.addMesh(names.next(body.name, std::exchange(is_first, false)), *mesh);
    }
    return true;
  } catch (const std::exception& error) {
    const std::string reason = error.what();
    std::cout << std::flush;
    std::cerr << "sdf_ccd: " << (body.failure.empty() ? "link " + body.name + ": " : "") << reason << std::endl;
    return false;
  }
}

/// Estimates the cost of all links before the first is built. Errors of a link are reported when it is built.
void expectLinks(const std::vector<BodyDescription>& bodies, FieldBuilder& builder) {
  for (const BodyDescription& body : bodies) {
    for (const GeometryDescription& element : body.geometry) {
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&element.shape);
      if (mesh && *mesh && body.failure.empty()) builder.expectMesh(body.name, *mesh);
    }
  }
  builder.requireAffordable();
}

void buildRobot(const Arguments& arguments) {
  const Robot robot = loadRobot(arguments);
  OutputDirectory out(arguments.out);
  FieldBuilder builder(out, arguments.resolution, arguments.spacing);
  expectLinks(robot.scene.bodies, builder);
  FileNames names(robot.scene.bodies);
  std::size_t failed = 0;
  for (const BodyDescription& body : robot.scene.bodies) failed += !buildLink(body, names, builder);
  std::cout << robot.scene.bodies.size() << " links, " << robot.pairs << " pairs to check, "
            << robot.scene.allowed.size() << " left out; ";
  builder.printTotals();
  if (failed > 0) throw PartlyDone();
}

#ifdef SDF_CCD_WITH_ROS
void prepare(const Arguments& arguments) {
  if (arguments.urdf.empty()) throw std::runtime_error("--config needs --urdf");
  if (arguments.spacing) throw std::runtime_error("--spacing: with --config, shell/spacing of that file counts");
  arguments.resolution.requireNone("with --config, the resolution comes from that file");
  prepareRobot({arguments.urdf, arguments.srdf, arguments.config, {}, {}}, arguments.out);
}
#endif

void run(Arguments& arguments) {
  if (!arguments.srdf.empty() && arguments.urdf.empty()) throw std::runtime_error("--srdf needs --urdf");
  if (arguments.spacing && !(*arguments.spacing > 0.0)) throw std::runtime_error("--spacing must be positive");
  arguments.resolution.fieldOptions();  // rejects bad values before anything is read
  const auto limit = arguments.threads.limit();
#ifdef SDF_CCD_WITH_ROS
  if (!arguments.config.empty()) return prepare(arguments);
#endif
  if (!arguments.urdf.empty()) return buildRobot(arguments);

  const bool is_mesh = !arguments.mesh.empty();
  const std::string& file = is_mesh ? arguments.mesh : arguments.octomap;
  double voxel_size = 0.0;
  const auto mesh =
      std::make_shared<const TriangleMesh>(is_mesh ? loadMesh(file) : loadOctomapSurface(file, voxel_size));
  OutputDirectory out(arguments.out);
  FieldBuilder builder(out, arguments.resolution, arguments.spacing);
  std::cout << stemOf(file) << ": " << file << "\n";
  if (is_mesh) {
    builder.expectMesh(stemOf(file), mesh);
  } else {
    builder.expectVoxels(stemOf(file), mesh, voxel_size);
  }
  builder.requireAffordable();
  if (is_mesh) {
    builder.addMesh(stemOf(file), mesh);
  } else {
    builder.addVoxels(stemOf(file), mesh, voxel_size);
  }
  builder.printTotals();
}

}  // namespace

void addBuildCommand(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("build", "Make fields and shells, and report on the meshes");
  command->footer(
      "Writes NAME.field and NAME.shell, each in its mesh's frame: for a robot per link, NAME the link's (a link's "
      "second mesh is NAME_2, or the next number that no other link is named by), else the file's name. package:// is "
      "looked up in ROS_PACKAGE_PATH.");
  auto* source = command->add_option_group("source");
  source->add_option("--urdf", arguments->urdf, "Robot; its links' collision meshes are taken");
  source->add_option("--mesh", arguments->mesh, "Mesh file: STL, DAE, OBJ, OFF, PLY, ...");
  source->add_option("--octomap", arguments->octomap, "World: .bt or .ot file; the default cell is half a voxel");
  source->require_option(1);
  command->add_option("--srdf", arguments->srdf, "With --urdf: pairs that need no check, for the count of pairs");
  command->add_option("--out", arguments->out, "Directory to write to; made if it is missing")->required();
  arguments->resolution.addTo(*command);
  command->add_option_function<double>(
      "--spacing", [arguments](double spacing) { arguments->spacing = spacing; },
      "Maximum distance from a surface to a shell point [m]; default two cells");
#ifdef SDF_CCD_WITH_ROS
  command->add_option(
      "--config", arguments->config,
      "With --urdf: the monitor's parameters, as config/monitor.yaml. Builds everything that the monitor builds at "
      "start-up, including the world's bodies; load it with cache_directory: DIR (or a copy of DIR)");
#endif
  arguments->threads.addTo(*command);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace sdf_ccd::tools
