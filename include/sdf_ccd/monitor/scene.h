#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/body/body_list.h"
#include "sdf_ccd/body/body_options.h"
#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/monitor/scene_plan.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

struct Scene {
  BodyList bodies;
  std::vector<PlannedPair> pairs;
  std::vector<LeftOut> left_out;
  std::vector<std::string> visual_only;  ///< as in SceneDescription: nothing is known of where they are solid
  std::vector<BodyReport> reports;
  std::vector<std::string> warnings;  ///< about its pairs, and those that several bodies share
  ErrorBound bound;                   ///< of verdicts, largest over all pairs; chord: as the options allow
  ErrorBound contact_bound;           ///< the same for times and depths of contacts, which come from fields and shells
  double motion_margin = 0.0, motion_error = 0.0;  ///< as in BodyOptions [m]
  std::optional<double> max_error;                 ///< as requested [m]
  double build_seconds = 0.0;
};

/// The options that planScene() needs.
inline PlanOptions planOptions(const BodyOptions& options) {
  PlanOptions plan;
  plan.shell_spacing = options.shell.spacing;
  plan.edge_gap = options.shell.edge_gap < options.shell.spacing ? options.shell.edge_gap : 0.0;
  return plan;
}

/// Builds, or loads from the cache, what the plan needs; meshes of equal content once. A body whose field or shell
/// cannot be built keeps its index, with Body::failure set; other bodies are not affected.
/// @param progress  called with the body's name and the share of all bodies done.
Scene buildScene(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options,
                 const std::function<void(const std::string&, double)>& progress = {});

/// Removes pairs from a scene that is built; bodies stay unchanged.
/// @param reasons  per pair: why it is removed; empty if it stays.
void leaveOut(const std::vector<std::string>& reasons, Scene& scene);

/// A scene of bodies that are already prepared, with all of their pairs except those of two world bodies.
/// @param motion_margin  as in BodyOptions [m].
/// @throws std::invalid_argument if two bodies share a name, one has neither field nor shell, or a pair has no shell to
/// test.
Scene makeScene(std::vector<Body> bodies, double motion_margin = 1e-3);

/// The plan as one table for the log: body, geometry, field, shell, cells, bytes, error bound by source, pairs; below
/// it failures, warnings, and what was left out, by reason.
std::string planTable(const Scene& scene);

}  // namespace sdf_ccd
