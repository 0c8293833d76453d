#include "robot_monitor/learn_pairs.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <set>
#include <stdexcept>
#include <variant>

#include "common/seconds_since.h"
#include "geometry/unit_hint.h"
#include "model/error_budget.h"
#include "observed_pairs.h"
#include "robot/joint_sampler.h"
#include "robot/srdf_pairs.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kAlways = 1000;  // random states that decide Always: each costs a search for contacts

/// Of each mesh once, for the first link that has it.
void warnOfUnits(const SceneDescription& description, std::vector<std::string>& warnings) {
  std::set<std::string> told;
  for (const BodyDescription& body : description.bodies) {
    for (const GeometryDescription& geometry : body.geometry) {
      const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&geometry.shape);
      const std::string hint = mesh ? unitHint(**mesh) : "";
      if (hint.empty() || !told.insert(geometry.source + hint).second) continue;
      warnings.push_back(body.name + ": " + geometry.source + ": " + hint);
    }
  }
}

/// Sorts the pairs of a described robot's bodies into those that have to be tested and those that need not.
class PairSorter {
 public:
  PairSorter(const RobotModel& robot, const Srdf& srdf) : robot_(robot), srdf_(srdf) {}

  /// False if the pair needs no test; it is then added to `pairs`.
  bool mustBeTested(const BodyDescription& a, const BodyDescription& b, LearnedPairs& pairs) const {
    if (isKnown(a.name, b.name)) {
      ++pairs.known;
    } else if (areJoined(a.name, b.name)) {
      pairs.disabled.push_back({a.name, b.name, "Adjacent"});
    } else if (!a.failure.empty() || !b.failure.empty()) {
      pairs.unknown.push_back({a.name, b.name, !a.failure.empty() ? a.failure : b.failure});
    } else if (const std::string joint =
                   JointSampler::unboundedBetween(robot_, robot_.find(a.name), robot_.find(b.name));
               !joint.empty()) {
      pairs.unknown.push_back({a.name, b.name, "joint " + joint + " is unbounded"});
    } else {
      return true;
    }
    return false;
  }

 private:
  /// Whether the SRDF has a rule for the pair.
  bool isKnown(const std::string& a, const std::string& b) const {
    return !srdf_.whyDisabled(a, b).empty() || srdf_.isEnabled(a, b) || srdf_.isDisabledByDefault(a) ||
           srdf_.isDisabledByDefault(b);
  }

  /// Whether they are joined rigidly or by one joint, with nothing between them.
  bool areJoined(const std::string& a, const std::string& b) const {
    return robot_.adjacent(a, b) || (robot_.rigidlyJoined(a, b) && robot_.neighbours(a, b));
  }

  const RobotModel& robot_;
  SrdfPairs srdf_;
};

BodyOptions sceneOptions(double max_error) {
  BodyOptions options = optionsFor({max_error});
  options.motion_margin = 0.0;  // nothing moves
  return options;
}

bool isClose(const ObservedPair& pair) {
  return pair.has(Nearness::kNear) || pair.has(Nearness::kOpen) || pair.has(Nearness::kHeld);
}

void sortOut(const PlannedPair& pair, const ObservedPair& seen, const Scene& scene, const LearnOptions& options,
             LearnedPairs& pairs) {
  LearnedPair found = {scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name, ""};
  const bool is_always = seen.areAlwaysTogether(), touches = seen.has(Nearness::kOverlap);
  if (seen.mayOverlapAtRest() && !is_always) pairs.at_default.push_back(found);
  if (seen.has(Nearness::kUnknown)) {
    const std::string& failure = scene.bodies[pair.body_a].failure;
    found.reason = failure.empty() ? scene.bodies[pair.body_b].failure : failure;
    if (found.reason.empty()) found.reason = "a state could not be tested";
    pairs.unknown.push_back(found);
  } else if (is_always) {
    found.reason = "Always";
    pairs.disabled.push_back(found);
  } else if (!touches && !isClose(seen)) {
    found.reason = "Never";
    pairs.disabled.push_back(found);
  } else if (options.default_pairs && seen.mayOverlapAtRest()) {
    found.reason = "Default";
    pairs.disabled.push_back(found);
  } else {
    (touches ? pairs.touching : pairs.close).push_back(found);
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
    if (seen.has(Nearness::kUnknown) || robot.rigidlyJoined(a, b)) return false;  // one state is enough
    return seen.areAlwaysTogether() ? random <= kAlways : !seen.has(Nearness::kOverlap);
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
  const PairSorter sorter(robot, srdf);
  description.allowed.clear();
  for (BodyDescription& body : description.bodies) body.rigid_root.clear();  // such pairs are tested, too
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < description.bodies.size(); ++j) {
      const BodyDescription &a = description.bodies[i], &b = description.bodies[j];
      if (!sorter.mustBeTested(a, b, pairs)) description.allowed.push_back({a.name, b.name, "not tested"});
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
