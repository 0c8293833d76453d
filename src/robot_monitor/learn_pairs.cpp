#include "robot_monitor/learn_pairs.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <variant>

#include "common/seconds_since.h"
#include "geometry/unit_hint.h"
#include "model/error_budget.h"
#include "model/name_pair.h"
#include "monitor/plan/scene_cost.h"
#include "robot/joint_motion.h"
#include "robot/joint_sampler.h"
#include "robot/srdf_pairs.h"
#include "robot/unreachable_pairs.h"
#include "state_verdicts.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kRound = 256;    // states between two updates of the undecided pairs
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

/// Of each joint the least and the greatest position.
std::map<std::string, Range> rangesOf(const JointStates& states) {
  std::map<std::string, Range> ranges;
  for (const std::vector<double>& positions : states.positions) {
    for (std::size_t j = 0; j < positions.size(); ++j) {
      Range& range = ranges.try_emplace(states.joints[j], positions[j], positions[j]).first->second;
      range = {std::min(range.first, positions[j]), std::max(range.second, positions[j])};
    }
  }
  return ranges;
}

/// Sorts the pairs of a described robot's bodies into those that have to be tested and those that need not.
class PairSorter {
 public:
  /// @param recorded  states in which joints may be beyond the limits that keep pairs apart.
  PairSorter(const RobotModel& robot, const Srdf& srdf, const SceneDescription& scene, const JointStates& recorded)
      : robot_(robot), srdf_(srdf) {
    const std::map<std::string, Range> ranges = rangesOf(recorded);
    for (const UnreachablePair& pair : unreachablePairs(robot, scene.bodies, scene.allowed)) {
      if (pair.X_AB) continue;
      const NamePair names = namePair(scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name);
      const auto isLeft = [&](const RobotModel::Slide& slide) { return isBeyond(slide, ranges); };
      const auto left = std::find_if(pair.slides.begin(), pair.slides.end(), isLeft);
      if (left == pair.slides.end()) {
        out_of_reach_.insert(names);
      } else {
        beyond_limits_.insert(left->joint);
      }
    }
  }

  /// Joints that were recorded so far beyond their limits that pairs may meet which the limits keep apart.
  const std::set<std::string>& beyondLimits() const { return beyond_limits_; }

  /// False if the pair needs no test; it is then added to `pairs`.
  bool mustBeTested(const BodyDescription& a, const BodyDescription& b, LearnedPairs& pairs) const {
    const NamePair names = namePair(a.name, b.name);
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
    } else if (out_of_reach_.count(names) > 0) {
      pairs.disabled.push_back({a.name, b.name, "Never"});
      ++pairs.proved;
    } else {
      return true;
    }
    return false;
  }

 private:
  /// Whether the joint, or the one that it mimics, was recorded beyond the range that is assumed.
  bool isBeyond(const RobotModel::Slide& slide, const std::map<std::string, Range>& recorded) const {
    const urdf::Joint& joint = *robot_.urdf().getJoint(slide.joint);
    const std::string& named = recorded.count(joint.name) > 0 ? joint.name : robot_.leader(joint).name;
    const auto range = recorded.find(named);
    if (range == recorded.end()) return false;
    const auto at = [&](double position) { return beyondReach(slide, robot_.position(joint, {{named, position}})); };
    return !at(range->second.first).empty() || !at(range->second.second).empty();
  }

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
  std::set<NamePair> out_of_reach_;
  std::set<std::string> beyond_limits_;
};

BodyOptions sceneOptions(double max_error) {
  BodyOptions options = optionsFor({max_error});
  options.motion_margin = 0.0;  // nothing moves
  return options;
}

/// Observations of one pair.
struct Seen {
  bool is_rigid = false;  // one state is enough
  bool touch = false, apart = false, close = false, unchecked = false, touch_at_default = false;

  /// Whether another state can change the result.
  /// @param is_long  whether it has been tested in more than kAlways random states.
  bool isOpen(bool is_long) const {
    if (is_rigid && (touch || apart || close)) return false;
    if (is_long && touch) return false;
    return !unchecked && !(touch && (apart || close));
  }
};

void sortOut(const PlannedPair& pair, const Seen& seen, const Scene& scene, const LearnOptions& options,
             LearnedPairs& pairs) {
  LearnedPair found = {scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name, ""};
  if (seen.touch_at_default && (seen.apart || seen.close)) pairs.at_default.push_back(found);
  if (seen.unchecked) {
    const std::string& failure = scene.bodies[pair.body_a].failure;
    found.reason = failure.empty() ? scene.bodies[pair.body_b].failure : failure;
    if (found.reason.empty()) found.reason = "a state could not be tested";
    pairs.unknown.push_back(found);
  } else if (seen.touch && !seen.apart && !seen.close) {
    found.reason = "Always";
    pairs.disabled.push_back(found);
  } else if (!seen.touch && !seen.close) {
    found.reason = "Never";
    pairs.disabled.push_back(found);
    pairs.proved += seen.is_rigid;
  } else if (options.default_pairs && seen.touch_at_default) {
    found.reason = "Default";
    pairs.disabled.push_back(found);
  } else {
    (seen.touch ? pairs.touching : pairs.close).push_back(found);
  }
}

/// The default state, the recorded ones, then random ones.
class States {
 public:
  States(const RobotModel& robot, const LearnOptions& options)
      : options_(options), sampler_(robot, options.seed), size_(1 + options.recorded.size() + options.states) {}

  std::size_t size() const { return size_; }
  bool atEnd() const { return next_ == size_; }
  std::size_t randomTaken() const {
    return next_ > options_.recorded.size() ? next_ - 1 - options_.recorded.size() : 0;
  }
  double share() const { return double(next_) / double(size_); }

  std::vector<JointPositions> take(std::size_t count) {
    std::vector<JointPositions> states;
    for (; states.size() < count && next_ < size_; ++next_) {
      const std::size_t recorded = next_ - 1;
      states.push_back(next_ == 0                            ? JointPositions()
                       : recorded < options_.recorded.size() ? options_.recorded.state(recorded)
                                                             : sampler_.next());
    }
    return states;
  }

 private:
  const LearnOptions& options_;
  JointSampler sampler_;
  std::size_t size_, next_ = 0;
};

/// Tests the scene's pairs in all states, each until it is known to need a check.
std::vector<Seen> testPairs(const RobotModel& robot, const Scene& scene, const LearnOptions& options) {
  std::vector<Seen> seen(scene.pairs.size());
  for (std::size_t p = 0; p < seen.size(); ++p) {
    seen[p].is_rigid =
        robot.rigidlyJoined(scene.bodies[scene.pairs[p].body_a].name, scene.bodies[scene.pairs[p].body_b].name);
  }
  // States between two in which a pair is closer than the bound may touch.
  const auto judge = [bound = scene.contact_bound.total()](const PairResult& pair) {
    const bool is_close = pair.verdict == Verdict::kClear && pair.clearance <= bound;
    return is_close ? Verdict::kUncertain : pair.verdict;
  };
  States states(robot, options);
  while (!states.atEnd()) {
    if (options.progress) options.progress("states", states.share());
    const bool is_default = states.share() == 0.0;
    std::vector<std::size_t> open;
    for (std::size_t p = 0; p < seen.size(); ++p)
      if (seen[p].isOpen(states.randomTaken() > kAlways)) open.push_back(p);
    if (open.empty()) break;
    // The first update comes early: most pairs that touch in some states do so in the first ones.
    const std::vector<JointPositions> round = states.take(is_default ? 1 : kRound);
    const std::vector<Verdict> verdicts = verdictsOf(robot, scene, open, round, judge);
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      Seen& pair = seen[open[i % open.size()]];
      pair.touch |= verdicts[i] == Verdict::kContact;
      pair.apart |= verdicts[i] == Verdict::kClear;
      pair.close |= verdicts[i] == Verdict::kUncertain;
      pair.unchecked |= verdicts[i] == Verdict::kNotChecked;
      pair.touch_at_default |= is_default && verdicts[i] == Verdict::kContact;
    }
  }
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
  RobotSceneOptions all;
  all.check_adjacent = true;
  SceneDescription description = describeRobot(robot, {}, loader, all, pairs.warnings);
  warnOfUnits(description, pairs.warnings);
  const JointSampler sampler(robot, options.seed);
  for (const std::string& joint : sampler.withoutLimits()) {
    pairs.warnings.push_back("joint " + joint + " has no limits: a full revolution is sampled");
  }
  const PairSorter sorter(robot, srdf, description, options.recorded);
  for (const std::string& joint : sorter.beyondLimits()) {
    pairs.warnings.push_back("joint " + joint +
                             " is recorded beyond its limits: pairs that these keep apart are tested, too");
  }
  description.allowed.clear();
  for (std::size_t i = 0; i < description.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < description.bodies.size(); ++j) {
      const BodyDescription &a = description.bodies[i], &b = description.bodies[j];
      if (!sorter.mustBeTested(a, b, pairs)) description.allowed.push_back({a.name, b.name, "not tested"});
    }
  }
  const auto build_progress = [&](const std::string&, double share) {
    if (options.progress) options.progress("fields and shells", share);
  };
  ScenePlan plan = planScene(description, planOptions(scene_options));
  plan.expected = std::make_shared<const SceneCost>(expectedCost(description, plan, scene_options));
  requireAffordable(*plan.expected, scene_options);
  const Scene scene = buildScene(description, plan, scene_options, build_progress);
  const auto built = Clock::now();
  const std::vector<Seen> seen = testPairs(robot, scene, options);
  for (std::size_t p = 0; p < seen.size(); ++p) sortOut(scene.pairs[p], seen[p], scene, options, pairs);
  pairs.error_bound = scene.contact_bound.total();
  pairs.build_seconds = std::chrono::duration<double>(built - start).count();
  pairs.test_seconds = secondsSince(built);
  return pairs;
}

}  // namespace sdf_ccd
