#include "prepare_robot.h"

#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "commands.h"
#include "monitor/over_budget.h"
#include "monitor_scene.h"
#include "print.h"
#include "storage/cache_directory.h"

namespace sdf_ccd::tools {
namespace {

namespace fs = std::filesystem;

struct Kept {
  std::size_t files = 0;
  std::size_t bytes = 0;
};

Kept keptIn(const std::string& directory) {
  Kept kept;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    if (entry.path().extension() != ".field" && entry.path().extension() != ".shell") continue;
    ++kept.files;
    kept.bytes += entry.file_size();
  }
  return kept;
}

void requireKept(const Scene& scene, const std::string& directory) {
  for (const BodyReport& report : scene.reports)
    if (report.is_cache_incomplete)
      throw std::runtime_error(report.name + ": not all of it is in " + directory + "; the warnings above say why");
}

}  // namespace

void prepareRobot(const MonitorConfig& config, const std::string& directory) {
  MonitorParameters parameters = readParameters(config);
  parameters.scene.cache_directory = fs::absolute(directory).lexically_normal().string();
  fs::create_directories(parameters.scene.cache_directory);  // other users may read it, unlike a private cache
  requireOwnDirectory(parameters.scene.cache_directory);
  const DescribedScene described = describeMonitored(parameters, config.urdf);
  const ScenePlan plan = affordablePlan(described, parameters.scene);
  std::cout << "expected         " << summary(*plan.expected) << "\n" << std::flush;
  const Interrupt interrupt;
  std::shared_ptr<const Scene> scene;
  try {
    scene = buildWithBar(described, plan, parameters.scene, interrupt);
  } catch (const Interrupted&) {
    throw std::runtime_error("interrupted: what was made is in " + directory);
  }
  std::vector<std::string> warnings = described.warnings;
  const std::string over = overBudget(*scene);
  if (!over.empty()) warnings.push_back(over);
  std::cout << planText(*scene, warnings);
  const bool is_complete = areAllMade(*scene);
  requireKept(*scene, directory);
  const Kept kept = keptIn(parameters.scene.cache_directory);
  std::cout << kept.files << " files, " << megabytes(kept.bytes)
            << "; the monitor loads them with cache_directory: " << parameters.scene.cache_directory
            << " and the same parameters" << std::endl;
  if (!is_complete) throw PartlyDone();
}

}  // namespace sdf_ccd::tools
