#include "scene_totals.h"

#include <algorithm>

#include "scene/pair_bound.h"

namespace sdf_ccd {
namespace {

bool isLarger(const ErrorSources& a, const ErrorSources& b) {
  return a.total() > b.total();
}

}  // namespace

Scene plannedScene(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options) {
  Scene scene;
  scene.pairs = plan.pairs;
  scene.left_out = plan.left_out;
  scene.visual_only = description.visual_only;
  scene.max_error = options.max_error;
  scene.motion_margin = options.motion_margin;
  scene.motion_error = options.motion_error;
  return scene;
}

std::size_t pairsOfObjects(const BodyList& bodies) {
  const std::size_t objects =
      std::count_if(bodies.begin(), bodies.end(), [](const Body& body) { return body.is_world; });
  return objects * (objects - std::min<std::size_t>(objects, 1)) / 2;
}

void setParts(const ScenePlan& plan, Scene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    PartReports& parts = scene.reports[b];
    if (!body.failure.empty()) {
      parts.surface = {body.map.empty() ? PartState::kFailed : PartState::kAwaited, body.failure};
      parts.field = parts.shell = parts.surface;
      continue;
    }
    parts.surface = plan.parts[b].surface;
    if (parts.field.state != PartState::kReady) parts.field = plan.parts[b].field;
    if (parts.shell.state != PartState::kReady) parts.shell = plan.parts[b].shell;
  }
}

void setTotals(Scene& scene) {
  scene.bound = scene.contact_bound = {};
  for (BodyReport& report : scene.reports) {
    report.bound = {};
    report.pairs = 0;
  }
  for (const PlannedPair& pair : scene.pairs) {
    ++scene.reports[pair.body_a].pairs;
    ++scene.reports[pair.body_b].pairs;
    if (!haveSurfaces(scene, pair)) continue;  // one of the bodies was not built
    const Body &a = scene.bodies[pair.body_a], &b = scene.bodies[pair.body_b];
    ErrorSources of_contacts = contactBound(a, b, pair);
    of_contacts.chord = scene.motion_margin;
    const ErrorSources bound{0.0, scene.motion_error, 0.0, deviationOf(a, b)};
    if (isLarger(of_contacts, scene.contact_bound)) scene.contact_bound = of_contacts;
    for (ErrorSources* largest : {&scene.reports[pair.body_a].bound, &scene.reports[pair.body_b].bound, &scene.bound})
      if (isLarger(bound, *largest)) *largest = bound;
  }
}

}  // namespace sdf_ccd
