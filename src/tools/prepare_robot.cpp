#include "prepare_robot.h"

#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "prepare_scene.h"
#include "robot/robot_files.h"
#include "robot_monitor/overlapping_pairs.h"
#include "scene/body_options.h"
#include "scene/error_budget.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::tools {
namespace {

/// Those of a monitor with default parameters, and the given resolution.
BodyOptions optionsOf(const RobotFiles& files) {
  const MonitorOptions monitor;
  const double tolerance = monitor.chords.tolerance;
  BodyOptions options = optionsForContacts();
  setMotionErrors(samplingTolerance(monitor.max_error, tolerance), tolerance, options);
  if (hasResolution(files.field)) {
    validate(files.field);
    if (files.field.cells == 1) throw std::invalid_argument("--resolution: the monitor needs two cells or more");
    setFieldResolution(files.field, options);
  }
  options.field.band = files.field.band;
  options.max_preparation_time = files.max_time;
  if (files.spacing) setShellSpacing(*files.spacing, options);
  return options;
}

/// The parameters of a monitor with these options, for the user: ", field: {cell_size: 0.002} and otherwise defaults".
std::string parametersOf(const RobotFiles& files) {
  const auto& [cells, cell_size, max_error, band, max_bytes] = files.field;
  static_cast<void>(max_bytes);
  std::string field;
  const auto add = [&](const std::string& setting) { field += (field.empty() ? "" : ", ") + setting; };
  if (cells) add(fmt::format("cells: {}", *cells));
  if (cell_size) add(fmt::format("cell_size: {}", *cell_size));
  if (max_error) add(fmt::format("max_error: {}", *max_error));
  if (band > 0.0) add(fmt::format("band: {}", band));
  std::string text;
  if (!field.empty()) text += fmt::format(", field: {{{}}}", field);
  if (files.spacing) text += fmt::format(", shell: {{spacing: {}}}", *files.spacing);
  return text + (text.empty() ? " and default parameters" : " and otherwise default parameters");
}

}  // namespace

void prepareRobot(const RobotFiles& files, const std::string& directory) {
  const LoadedRobot robot = loadRobot(files.urdf, files.srdf);
  const OverlapRule overlaps = overlapRule(OverlapRule::Kind::kNeighbours, robot.srdf);
  Preparation preparation;
  preparation.options = optionsOf(files);
  preparation.scene = describeRobot(robot.model, robot.srdf, robot.loader, {}, preparation.warnings);
  preparation.build = [&](const ScenePlan& plan, const BodyOptions& options, const SceneProgress& progress) {
    Scene scene = buildScene(preparation.scene, plan, options, progress);
    applyOverlapRule(robot.model, overlaps, scene);
    return std::make_shared<const Scene>(std::move(scene));
  };
  preparation.parameters = parametersOf(files);
  prepareScene(preparation, directory);
}

}  // namespace sdf_ccd::tools
