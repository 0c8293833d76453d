#include "prepare_scene.h"

#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "commands.h"
#include "common/files/cache_directory.h"
#include "common/files/file_cache.h"
#include "common/number_text.h"
#include "monitor/over_budget.h"
#include "output_file.h"

namespace sdf_ccd::tools {
namespace {

namespace fs = std::filesystem;

void requireKept(const Scene& scene, const std::string& directory) {
  for (const BodyReport& report : scene.reports)
    if (report.is_cache_incomplete)
      throw std::runtime_error(report.name + ": not all of it is in " + directory + "; the warnings above say why");
}

void printSolids(const Scene& scene) {
  for (const BodyReport& report : scene.reports)
    if (!report.solid.empty()) std::cout << report.name << ": " << report.solid << "\n";
}

void printFiles(const Scene& scene, const std::string& directory, const std::string& parameters) {
  std::set<std::string> files;
  for (const BodyReport& report : scene.reports) files.insert(report.files.begin(), report.files.end());
  std::size_t bytes = 0;
  for (const std::string& file : files) {
    std::error_code gone;
    bytes += fs::file_size(fs::path(directory) / file, gone);
    if (gone)
      throw std::runtime_error(fmt::format("{}: {} was deleted; a cache keeps {} at most", directory, file,
                                           memoryText(double(FileCache::kMaxBytes))));
  }
  if (files.empty()) {
    std::cout << "no files: the bodies that are checked need none" << std::endl;
  } else {
    std::cout << files.size() << " files, " << memoryText(double(bytes))
              << "; the monitor loads them with cache_directory: " << directory << parameters << std::endl;
  }
}

}  // namespace

void prepareScene(const Preparation& preparation, const std::string& directory) {
  BodyOptions options = preparation.options;
  options.cache_directory = fs::absolute(directory).lexically_normal().string();
  const OutputDirectory out(directory);  // other users may read it, unlike a private cache
  requireOwnDirectory(options.cache_directory);
  const ScenePlan plan = planScene(preparation.scene, planOptions(options));
  const Interrupt interrupt;
  std::shared_ptr<const Scene> scene;
  try {
    buildSceneWithBar([&](const SceneProgress& progress) { scene = preparation.build(plan, options, progress); },
                      interrupt);
  } catch (const Interrupted&) {
    throw std::runtime_error("interrupted: what was made is in " + directory);
  }
  const std::string over = overBudget(*scene);
  std::vector<std::string> warnings = preparation.warnings;
  if (!over.empty()) warnings.push_back(over);
  std::cout << planText(*scene, warnings);
  printSolids(*scene);
  const bool is_complete = areAllMade(*scene);
  requireKept(*scene, directory);
  printFiles(*scene, options.cache_directory, preparation.parameters);
  if (!is_complete) throw PartlyDone();
}

}  // namespace sdf_ccd::tools
