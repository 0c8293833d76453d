#include "robot_monitor/learn_pairs.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <variant>

#include "common/seconds_since.h"
#include "mesh/unit_hint.h"
#include "observed_pairs.h"
#include "robot/joint_sampler.h"
#include "robot/srdf_pairs.h"
#include "scene/error_budget.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kAlways = 1000;  // random states that decide Always: each costs a search for contacts

/// Of each mesh once, for the first link that has it.
void warnOfUnits(const SceneDescription& description, std::vector<std::string>& warnings) {
  std::set<std::string> reported;
  for (const BodyDescription& body : description.bodies) {
    for (const GeometryDescription& geometry : body.geometry) {
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
      const std::string hint = mesh ? unitHint(**mesh) : "";
      if (hint.empty() || !reported.insert(geometry.source + hint).second) continue;
      warnings.push_back(body.name + ": " + geometry.source + ": " + hint);
    }
  }
}

/// False if the pair needs no test; it is then added to `pairs`.
bool mustBeTested(const RobotModel& robot, const SrdfPairs& srdf, const BodyDescription& a, const BodyDescription& b,
                  LearnedPairs& pairs) {
  const bool has_rule = !srdf.whyDisabled(a.name, b.name).empty() || srdf.isEnabled(a.name, b.name) ||
                        srdf.isDisabledByDefault(a.name) || srdf.isDisabledByDefault(b.name);
  const bool are_joined =
      robot.adjacent(a.name, b.name) || (robot.rigidlyJoined(a.name, b.name) && robot.neighbours(a.name, b.name));
  const std::string unbounded = JointSampler::unboundedBetween(robot, robot.find(a.name), robot.find(b.name));
  const std::string& failure = a.failure.empty() ? b.failure : a.failure;
  if (has_rule) {
    ++pairs.known;
  } else if (are_joined) {
    pairs.disabled.push_back({a.name, b.name, "", PairKind::kAdjacent});
  } else if (!failure.empty()) {
    pairs.unknown.push_back({a.name, b.name, failure});
  } else if (!unbounded.empty()) {
    pairs.unknown.push_back({a.name, b.name, "joint " + unbounded + " is unbounded"});
  } else {
    return true;
  }
  return false;
}

BodyOptions sceneOptions(double max_error) {
  BodyOptions options = optionsFor({max_error});
  options.motion_margin = 0.0;  // nothing moves
  return options;
}

void sortOut(const PlannedPair& pair, const ObservedPair& seen, const Scene& scene, const LearnOptions& options,
             LearnedPairs& pairs) {
  PairDecision found = {scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name};
  const Together together = seen.together();
  if (seen.mayOverlapAtRest() && together != Together::kAlways) pairs.at_default.push_back(found);
  const auto disable = [&](PairKind kind) {
    found.kind = kind;
    pairs.disabled.push_back(found);
  };
  if (together == Together::kUnknown) {
    const std::string& failure = scene.bodies[pair.body_a].failure;
    found.text = failure.empty() ? scene.bodies[pair.body_b].failure : failure;
    if (found.text.empty()) found.text = "a state could not be tested";
    pairs.unknown.push_back(found);
  } else if (together == Together::kAlways) {
    disable(PairKind::kAlways);
  } else if (together == Together::kNever) {
    disable(PairKind::kNever);
  } else if (options.default_pairs && seen.mayOverlapAtRest()) {
    disable(PairKind::kAtRest);
  } else {
    (together == Together::kSometimes ? pairs.touching : pairs.close).push_back(found);
  }
}

/// Tests the scene's pairs in all states, each until it is known to need a check.
std::vector<ObservedPair> testPairs(const RobotModel& robot, const Scene& scene, const LearnOptions& options) {
  std::vector<std::size_t> all(scene.pairs.size());
  std::iota(all.begin(), all.end(), 0);
  Observation observation;
  observation.recorded = &options.recorded;
  observation.random_states = options.states;
  observation.seed = options.seed;
  // States between two in which a pair is closer than the bound may touch.
  observation.near = scene.contact_bound.total();
  observation.is_open = [&](std::size_t p, const ObservedPair& seen, std::size_t random) {
    const std::string &a = scene.bodies[scene.pairs[p].body_a].name, &b = scene.bodies[scene.pairs[p].body_b].name;
    if (seen.together() == Together::kUnknown || robot.rigidlyJoined(a, b)) return false;  // one state is enough
    return seen.together() == Together::kAlways ? random <= kAlways : seen.together() != Together::kSometimes;
  };
  if (options.progress) observation.progress = [&](double share) { options.progress("states", share); };
  std::vector<ObservedPair> seen = observePairs(robot, scene, all, observation);
  if (options.progress) options.progress("states", 1.0);
  return seen;
}

}  // namespace

LearnedPairs learnPairs(const RobotModel& robot, const Srdf& srdf, const ResourceLoader& loader,
                        const LearnOptions& options) {
  if (options.states + options.recorded.size() == 0) throw std::invalid_argument("there are no states to learn from");
  const BodyOptions scene_options = sceneOptions(options.max_error);
  const auto start = Clock::now();
  LearnedPairs pairs;
  pairs.warnings = srdf.warnings;
  pairs.states = options.states;
  pairs.always_states = std::min(options.states, kAlways);
  pairs.recorded = options.recorded.size();
  pairs.seed = options.seed;
  SceneDescription description = describeRobot(robot, {}, loader, {}, pairs.warnings);
  warnOfUnits(description, pairs.warnings);
  const JointSampler sampler(robot, options.seed);
  for (const std::string& joint : sampler.withoutLimits()) {
    pairs.warnings.push_back("joint " + joint + " has no limits: a full revolution is sampled");
  }
  const SrdfPairs given(srdf);
  description.allowed.clear();
  for (BodyDescription& body : description.bodies) body.rigid_root.clear();  // such pairs are tested, too
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < description.bodies.size(); ++j) {
      const BodyDescription &a = description.bodies[i], &b = description.bodies[j];
      if (!mustBeTested(robot, given, a, b, pairs)) description.allowed.push_back({a.name, b.name, "not tested"});
    }
  }
  const auto build_progress = [&](const std::string&, double share) {
    if (options.progress) options.progress("fields and shells", share);
  };
  const ScenePlan plan = planScene(description, planOptions(scene_options));
  const Scene scene = buildScene(description, plan, scene_options, build_progress);
  const auto built = Clock::now();
  const std::vector<ObservedPair> seen = testPairs(robot, scene, options);
  for (std::size_t p = 0; p < seen.size(); ++p) sortOut(scene.pairs[p], seen[p], scene, options, pairs);
  pairs.error_bound = scene.contact_bound.total();
  pairs.build_seconds = std::chrono::duration<double>(built - start).count();
  pairs.test_seconds = secondsSince(built);
  return pairs;
}

}  // namespace sdf_ccd
