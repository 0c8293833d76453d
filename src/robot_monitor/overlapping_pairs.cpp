#include "overlapping_pairs.h"

#include <string>
#include <utility>

#include "observed_pairs.h"
#include "robot/joint_sampler.h"

namespace sdf_ccd {
namespace {

using Kind = OverlapRule::Kind;

constexpr std::size_t kStates = 200;

/// Decides which of a scene's pairs of links are set aside.
class Decider {
 public:
  Decider(const RobotModel& robot, const OverlapRule& rule, const Scene& scene)
      : robot_(robot), rule_(rule), scene_(scene) {}

  /// Pairs of two links that can be checked.
  std::vector<std::size_t> tested() const {
    std::vector<std::size_t> pairs;
    for (std::size_t p = 0; p < scene_.pairs.size(); ++p)
      if (linkOf(scene_.pairs[p].body_a) >= 0 && linkOf(scene_.pairs[p].body_b) >= 0) pairs.push_back(p);
    return pairs;
  }

  std::vector<ObservedPair> observe(const std::vector<std::size_t>& pairs) const {
    Observation observation;
    observation.random_states = rule_.kind == Kind::kNeighbours || rule_.kind == Kind::kLeaveOut ? kStates : 0;
    observation.is_open = [&](std::size_t pair, const ObservedPair& observed, std::size_t) {
      return observed.areAlwaysTogether() && mayBeSetAside(pair) && !isNeighbours(pair, observed);
    };
    return observePairs(robot_, scene_, pairs, observation);
  }

  /// Why the pair is set aside; empty if it stays.
  std::string reason(std::size_t pair, const ObservedPair& observed) const {
    if (isKept(pair) || !mayBeSetAside(pair)) return {};
    if (rule_.kind == Kind::kRest && observed.mayOverlapAtRest()) return "overlap at rest, or may" + kNoProof;
    if (isNeighbours(pair, observed)) return "overlap at rest, with at most two movable joints between them" + kNoProof;
    if (!isAlways(observed)) return {};
    const std::string states = " in all of " + std::to_string(kStates) + " random states" + kNoProof;
    return observed.at_rest == Nearness::kHeld
               ? "come within 1 mm as neighbours at rest, and overlap or come within 1 mm" + states
               : "overlap at rest and overlap or, as neighbours, come within 1 mm" + states;
  }

  RestOverlap atRest(std::size_t pair, const ObservedPair& observed) const {
    const RestOverlap::Kind kind = observed.at_rest == Nearness::kOverlap ? RestOverlap::Kind::kOverlap
                                   : observed.at_rest == Nearness::kHeld  ? RestOverlap::Kind::kTouching
                                                                          : RestOverlap::Kind::kOpen;
    return {nameA(pair), nameB(pair), kind, observed.rest_depth, isAlways(observed), false, isKept(pair)};
  }

  bool isKept(std::size_t pair) const { return matchesAny(rule_.kept, nameA(pair), nameB(pair)); }

  const std::string& nameA(std::size_t pair) const { return scene_.bodies[scene_.pairs[pair].body_a].name; }
  const std::string& nameB(std::size_t pair) const { return scene_.bodies[scene_.pairs[pair].body_b].name; }

 private:
  inline static const std::string kNoProof = ", which is no proof for others";

  int linkOf(int body) const {
    const Body& of = scene_.bodies[body];
    return of.is_world || !of.failure.empty() ? -1 : robot_.find(of.name);
  }

  bool mayBeSetAside(std::size_t pair) const {
    if (rule_.kind == Kind::kCheck || robot_.adjacent(nameA(pair), nameB(pair))) return false;
    return rule_.kind == Kind::kRest ||
           JointSampler::unboundedBetween(robot_, robot_.find(nameA(pair)), robot_.find(nameB(pair))).empty();
  }

  bool isNeighbours(std::size_t pair, const ObservedPair& observed) const {
    constexpr std::size_t kJoints = 2;
    return rule_.kind == Kind::kNeighbours && observed.at_rest == Nearness::kOverlap &&
           movableJointsBetween(robot_.find(nameA(pair)), robot_.find(nameB(pair))) <= kJoints;
  }

  /// By the links' indices.
  std::size_t movableJointsBetween(int a, int b) const {
    std::size_t count = 0;
    while (a != b) {
      int& lower = a > b ? a : b;  // depth-first order: the greater index is no ancestor
      count += robot_.jointAbove(lower).type != urdf::Joint::FIXED;
      lower = robot_.parent(lower);
    }
    return count;
  }

  static bool isAlways(const ObservedPair& observed) {
    return observed.areAlwaysTogether() && observed.tested == 1 + kStates;
  }

  const RobotModel& robot_;
  const OverlapRule& rule_;
  const Scene& scene_;
};

}  // namespace

std::vector<RestOverlap> applyOverlapRule(const RobotModel& robot, const OverlapRule& rule, Scene& scene) {
  std::vector<RestOverlap> overlaps;
  std::vector<LeftOutReason> reasons(scene.pairs.size());
  const Decider decider(robot, rule, scene);
  const std::vector<std::size_t> tested = decider.tested();
  const std::vector<ObservedPair> observed = decider.observe(tested);
  for (std::size_t k = 0; k < tested.size(); ++k) {
    std::string reason = decider.reason(tested[k], observed[k]);
    if (reason.empty() && !observed[k].mayOverlapAtRest()) continue;
    overlaps.push_back(decider.atRest(tested[k], observed[k]));
    overlaps.back().is_set_aside = !reason.empty();
    reasons[tested[k]] = {std::move(reason), overlaps.back().depth};
  }
  leaveOut(reasons, scene);
  for (const std::string& text : {setAsideText(overlaps), checkedOverlapsText(overlaps)})
    if (!text.empty()) scene.warnings.push_back(text);
  return overlaps;
}

}  // namespace sdf_ccd
