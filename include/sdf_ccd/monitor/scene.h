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
  ErrorBound bound;                   ///< of verdicts, the largest of all pairs; chord: what the options allow for
  ErrorBound contact_bound;           ///< the same of contacts' times and depths, which fields and shells tell
  double motion_margin = 0.0, motion_error = 0.0;  ///< as in BodyOptions [m]
  std::optional<double> max_error;                 ///< that was wanted [m]
  double build_seconds = 0.0;
};

/// What planScene() has to know of the options.
inline PlanOptions planOptions(const BodyOptions& options) {
  PlanOptions plan;
  plan.shell_spacing = options.shell.spacing;
  plan.edge_gap = options.shell.edge_gap < options.shell.spacing ? options.shell.edge_gap : 0.0;
  return plan;
}

/// Builds, or takes from the cache, what the plan needs; meshes of equal content once. A body whose field or shell
/// cannot be built keeps its place with Body::failure set; the others are not touched by it.
/// @param progress  called with the body's name and the share of all bodies done.
Scene buildScene(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options,
                 const std::function<void(const std::string&, double)>& progress = {});

/// Takes pairs out of a scene that is built; bodies stay as they are.
/// @param reasons  per pair; of those that stay empty.
void leaveOut(const std::vector<std::string>& reasons, Scene& scene);

/// A scene of bodies that are prepared already: all of its pairs, but those of two bodies of the world.
/// @param motion_margin  as in BodyOptions [m].
/// @throws std::invalid_argument if two bodies share a name, one has neither field nor shell, or two that are not both
/// of the world have no shell to test.
Scene makeScene(std::vector<Body> bodies, double motion_margin = 1e-3);

/// The plan as one table for the log: body, geometry, field, shell, cells, bytes, error bound by source, pairs; below
/// it what failed, what to know, and what was left out, by reason.
std::string planTable(const Scene& scene);

}  // namespace sdf_ccd
