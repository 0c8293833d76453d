#include "study.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "oracle/shapes.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::benchmark {

bool isWanted(const std::vector<std::string>& wanted, const std::string& name) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

std::vector<NamedMesh> studyMeshes(const StudyOptions& options) {
  std::vector<NamedMesh> meshes;
  for (const std::string& argument : options.mesh_files) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("--mesh " + argument + ": NAME=FILE is wanted");
    const std::string name = argument.substr(0, equals);
    if (!isWanted(options.meshes, name)) {
      std::fprintf(stderr, "mesh %s is left out; --meshes %s asks for it\n", name.c_str(), name.c_str());
      continue;
    }
    meshes.push_back({name, orientOutward(loadMesh(argument.substr(equals + 1))).mesh});
  }
  if (meshes.empty()) {
    meshes.push_back({"torus", test::torusMesh(0.2, 0.08, 128, 64)});
    meshes.push_back({"box", test::boxMesh({0.2, 0.15, 0.1})});
  }
  return meshes;
}

int runStudy(int argc, char** argv, const std::string& description, const StudyOptions& full, const StudyOptions& quick,
             const std::function<void(const StudyOptions&)>& study) {
  const bool is_quick = std::any_of(argv, argv + argc, [](const char* a) { return std::strcmp(a, "--quick") == 0; });
  StudyOptions options = is_quick ? quick : full;
  options.quick = is_quick;
  CLI::App app{description};
  app.add_flag("--quick", "coarse fields and small sets");
  app.add_option("--mesh", options.mesh_files, "NAME=FILE, as often as wanted; without any, shapes of our own");
  app.add_option("--robot", options.robots, "NAME=URDF[,SRDF], as often as wanted; for `robots` and `monitor`");
  app.add_option("--bag", options.bag, "in which the robot moves (anytime); without it, a motion of our own");
  app.add_option("--map", options.map, "an OctoMap, .bt (map); without it, a room of our own");
  app.add_option("--queries", options.queries,
                 "folder of Sample-Queries (truth); without it, the family public is left out");
  app.add_option("--meshes", options.meshes, "only those names")->delimiter(',');
  app.add_option("--cells", options.cells, "uniform fields: cells along the longest side")->delimiter(',');
  app.add_option("--errors", options.errors, "fields to a maximum error, in box sides")->delimiter(',');
  app.add_option("--cases", options.cases, "only those (segment: A, B1, …; shell: random, small, …)")->delimiter(',');
  app.add_option("--systems", options.systems, "only these systems (study monitor)")->delimiter(',');
  app.add_option("--paper", options.paper_meshes, "meshes that get the paper's dense grids too")->delimiter(',');
  app.add_option("--segments", options.segments, "per case")->check(CLI::Range(1000, 100'000'000));
  app.add_option("--motions", options.motions, "per family (truth)")->check(CLI::Range(100L, 1'000'000'000L));
  app.add_option("--pairs", options.pairs, "pose pairs per case")->check(CLI::Range(10, 1'000'000));
  app.add_option("--cycles", options.cycles, "milliseconds of motion per case (monitor)")
      ->check(CLI::Range(100, 10'000'000));
  app.add_option("--plots", options.plots, "directory for plots that the study draws itself (work-precision)");
  app.add_option("--runs", options.measure.runs, "per system")->check(CLI::Range(1, 1000));
  app.add_option("--seconds", options.measure.seconds, "a run lasts at least so long");
  CLI11_PARSE(app, argc, argv);
  try {
    study(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
  return 0;
}

}  // namespace sdf_ccd::benchmark
