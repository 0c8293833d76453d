#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <stdexcept>

#include "common/cancel_point.h"
#include "common/number_text.h"
#include "common/seconds_since.h"
#include "resting_answers.h"
#include "scene/build_body.h"
#include "scene/name_pair.h"
#include "scene/plan/scene_totals.h"
#include "scene/plan/surface_needs.h"
#include "sdf_ccd/scene.h"
#include "shell/point_shell.h"
#include "untestable_pairs.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

/// Of bodies' bounded elements.
void requireSmallerThanBodies(const SceneDescription& description, double max_error) {
  std::string largest;
  double longest = 0.0;  // [m]
  for (const BodyDescription& body : description.bodies) {
    for (const GeometryDescription& geometry : body.geometry) {
      const auto* primitive = std::get_if<Primitive>(&geometry.shape);
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
      if (mesh && !*mesh) continue;
      const AlignedBox3d box = primitive ? boundingBox(*primitive) : boundingBox(**mesh);
      if (!box.sizes().allFinite() || box.isEmpty() || box.sizes().norm() <= longest) continue;
      longest = box.sizes().norm();
      largest = body.name;
    }
  }
  if (longest == 0.0 || max_error <= longest) return;
  throw std::invalid_argument("a max_error of " + numberText(max_error) + " m is larger than every body: " + largest +
                              " is " + numberText(longest) + " m long");
}

/// Warnings that several reports share, as of a cache that cannot be used, are the scene's: once, not body by body.
void shareWarnings(Scene& scene) {
  std::map<std::string, std::set<std::string>> bodies_of;  // by warning
  for (const BodyReport& report : scene.reports)
    for (const std::string& warning : report.warnings) bodies_of[warning].insert(report.name);
  for (BodyReport& report : scene.reports) {
    std::set<std::string> own;
    const auto is_told = [&](const std::string& warning) {
      return bodies_of[warning].size() > 1 || !own.insert(warning).second;
    };
    report.warnings.erase(std::remove_if(report.warnings.begin(), report.warnings.end(), is_told),
                          report.warnings.end());
  }
  for (const auto& [warning, bodies] : bodies_of)
    if (bodies.size() > 1) scene.warnings.push_back(warning + " (" + std::to_string(bodies.size()) + " bodies)");
}

void addPair(const std::vector<Body>& bodies, int a, int b, Scene& scene) {
  const Body &body_a = bodies[a], &body_b = bodies[b];
  if (body_a.is_world && body_b.is_world) return;
  const bool a_shell = body_a.shell->size() > 0, b_shell = body_b.shell->size() > 0;
  scene.pairs.push_back({a, b, a_shell && !body_b.parts.empty(), b_shell && !body_a.parts.empty()});
}

}  // namespace

Scene buildScene(const SceneDescription& description, const ScenePlan& plan, const BodyOptions& options,
                 const std::function<void(const std::string&, double)>& progress) {
  const auto start = Clock::now();
  if (options.max_error) requireSmallerThanBodies(description, *options.max_error);
  Scene scene = plannedScene(description, plan, options);
  scene.resting = std::make_shared<RestingAnswers>();
  MeshPool pool(options);
  const std::size_t count = description.bodies.size();
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    const BodyDescription& described = description.bodies[i];
    checkCancelled();
    const auto report_progress = [&](double share) {
      if (progress) progress(described.name, (double(i) + share) / double(count));
    };
    report_progress(0.0);
    BuiltBody built = buildBody(described, plan.needs[i], options, pool, report_progress);
    if (built.exceeds_limit && options.divides_max_error)
      throw std::length_error("a max_error of " + numberText(*options.max_error) + " m is too small for " +
                              described.name + ": " + built.body.failure);
    bodies.push_back(std::move(built.body));
    scene.reports.push_back(std::move(built.report));
  }
  for (std::size_t i = 0; i < count; ++i) {
    Body& body = bodies[i];
    if (needsSurface(description, description.bodies[i]) && body.failure.empty() && !body.surface)
      body.surface = surfaceOf(description.bodies[i], pool);
  }
  shareWarnings(scene);
  scene.bodies = BodyList(std::move(bodies));
  warnOfUntestable(scene);
  if (progress && count > 0) progress(description.bodies.back().name, 1.0);
  setParts(plan, scene);
  setTotals(scene);
  scene.build_seconds = secondsSince(start);
  return scene;
}

Scene makeScene(std::vector<Body> bodies, double motion_margin) {
  Scene scene;
  std::set<std::string> names;
  for (const Body& body : bodies) {
    if (!names.insert(body.name).second) throw std::invalid_argument("two bodies are named " + body.name);
    if (body.failure.empty() && body.parts.empty() && body.shell->size() == 0)
      throw std::invalid_argument("body " + body.name + " has neither a field nor a shell");
    scene.reports.emplace_back().name = body.name;
  }
  for (int a = 0; a < static_cast<int>(bodies.size()); ++a)
    for (int b = a + 1; b < static_cast<int>(bodies.size()); ++b) addPair(bodies, a, b, scene);
  scene.bodies = BodyList(std::move(bodies));
  warnOfUntestable(scene);
  scene.motion_margin = scene.motion_error = motion_margin;
  scene.resting = std::make_shared<RestingAnswers>();
  setTotals(scene);
  return scene;
}

void leaveOut(const std::vector<PairDecision>& pairs, Scene& scene) {
  std::set<std::pair<int, int>> removed;
  for (const PairDecision& pair : pairs) removed.emplace(pair.a, pair.b);
  const auto is_removed = [&](const PlannedPair& pair) { return removed.count({pair.body_a, pair.body_b}) > 0; };
  scene.pairs.erase(std::remove_if(scene.pairs.begin(), scene.pairs.end(), is_removed), scene.pairs.end());
  scene.left_out.insert(scene.left_out.end(), pairs.begin(), pairs.end());
  setTotals(scene);
}

}  // namespace sdf_ccd
