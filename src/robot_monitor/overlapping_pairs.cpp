#include "overlapping_pairs.h"

#include <algorithm>
#include <set>
#include <utility>

#include "common/counted.h"
#include "common/number_text.h"
#include "observed_pairs.h"
#include "robot/joint_chain.h"
#include "robot/joint_sampler.h"
#include "robot/srdf_pairs.h"
#include "scene/name_pair.h"

namespace sdf_ccd {
namespace {

using Kind = OverlapRule::Kind;
using Pairs = std::vector<PairDecision>;

constexpr std::size_t kStates = 200;
constexpr std::size_t kNamed = 6, kLines = 100;  // at most so many pairs in a sentence, and in the lines below it

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
      return observed.together() == Together::kAlways && mayBeSetAside(pair) && !isNeighbours(pair, observed);
    };
    return observePairs(robot_, scene_, pairs, observation);
  }

  /// The text is empty if the pair stays.
  PairDecision decide(std::size_t pair, const ObservedPair& observed) const {
    const PlannedPair& planned = scene_.pairs[pair];
    PairDecision made{scene_.bodies[planned.body_a].name, scene_.bodies[planned.body_b].name};
    made.a = planned.body_a;
    made.b = planned.body_b;
    made.depth = observed.rest_depth;
    const bool is_always = observed.together() == Together::kAlways && observed.tested == 1 + kStates;
    made.kind = observed.at_rest == Nearness::kOverlap ? (is_always ? PairKind::kAlways : PairKind::kAtRest)
                : observed.at_rest == Nearness::kHeld  ? (is_always ? PairKind::kHeld : PairKind::kHeldAtRest)
                                                       : PairKind::kMayAtRest;
    if (!mayBeSetAside(pair) || matchesAny(rule_.kept, made.body_a, made.body_b)) return made;
    if (rule_.kind == Kind::kRest && observed.mayOverlapAtRest()) {
      made.text = "overlap at rest, or may";
    } else if (isNeighbours(pair, observed)) {
      made.text = "overlap at rest, with at most two movable joints between them";
    } else if (is_always) {
      made.text = std::string(made.kind == PairKind::kHeld ? "come within 1 mm as neighbours" : "overlap") +
                  " at rest and overlap or, as neighbours, come within 1 mm in all of " + std::to_string(kStates) +
                  " random states";
    }
    if (!made.text.empty()) made.text += ", which is no proof for others";
    return made;
  }

 private:
  int linkOf(int body) const {
    const Body& of = scene_.bodies[body];
    return of.is_world || !of.failure.empty() ? -1 : robot_.find(of.name);
  }

  bool mayBeSetAside(std::size_t pair) const {
    const int a = linkOf(scene_.pairs[pair].body_a), b = linkOf(scene_.pairs[pair].body_b);
    if (rule_.kind == Kind::kCheck || robot_.adjacent(robot_.links()[a], robot_.links()[b])) return false;
    return rule_.kind == Kind::kRest || JointSampler::unboundedBetween(robot_, a, b).empty();
  }

  bool isNeighbours(std::size_t pair, const ObservedPair& observed) const {
    constexpr std::size_t kJoints = 2;
    const PlannedPair& planned = scene_.pairs[pair];
    return rule_.kind == Kind::kNeighbours && observed.at_rest == Nearness::kOverlap &&
           jointsThatMove(robot_, linkOf(planned.body_a), linkOf(planned.body_b)).size() <= kJoints;
  }

  const RobotModel& robot_;
  const OverlapRule& rule_;
  const Scene& scene_;
};

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    xml += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return xml;
}

/// A line of an SRDF for each pair that the user has not named.
std::string srdfLines(const Pairs& pairs, const OverlapRule& rule) {
  std::vector<std::string> lines;
  for (const PairDecision& pair : pairs) {
    if (matchesAny(rule.kept, pair.body_a, pair.body_b)) continue;
    lines.push_back("\n<disable_collisions link1=\"" + escaped(pair.body_a) + "\" link2=\"" + escaped(pair.body_b) +
                    "\" reason=\"" + srdfReason(pair.kind) + "\"/>");
  }
  return firstOf(lines, kLines, "", "\nand ");
}

/// How two links are at rest: " (30 mm)", " (within 1 mm)", " (may overlap)"; empty for a depth that is not known.
std::string restText(const PairDecision& pair) {
  if (pair.depth > 0.0) return " (" + lengthText(pair.depth) + ")";
  if (pair.kind == PairKind::kHeld || pair.kind == PairKind::kHeldAtRest) return " (within 1 mm)";
  return pair.kind == PairKind::kMayAtRest ? " (may overlap)" : "";
}

/// "3 pairs that overlap at rest are WHAT: a - b (30 mm), c - d (within 1 mm), ...".
std::string sentence(const Pairs& pairs, const std::string& what) {
  std::vector<std::string> names;
  for (const PairDecision& pair : pairs) names.push_back(pairName(pair.body_a, pair.body_b) + restText(pair));
  const bool is_one = pairs.size() == 1;
  return counted(pairs.size(), "pair") + (is_one ? " that overlaps at rest is " : " that overlap at rest are ") + what +
         ": " + firstOf(names, kNamed);
}

}  // namespace

OverlapRule overlapRule(OverlapRule::Kind kind, const Srdf& srdf, std::vector<PairRule> kept) {
  for (const auto& [a, b] : srdf.enabled) kept.push_back({a, b});
  return {kind, std::move(kept)};
}

std::vector<PairDecision> applyOverlapRule(const RobotModel& robot, const OverlapRule& rule, Scene& scene) {
  Pairs found, set_aside;
  const Decider decider(robot, rule, scene);
  const std::vector<std::size_t> tested = decider.tested();
  const std::vector<ObservedPair> observed = decider.observe(tested);
  for (std::size_t k = 0; k < tested.size(); ++k) {
    const PairDecision pair = decider.decide(tested[k], observed[k]);
    if (!pair.text.empty()) set_aside.push_back(pair);
    if (!pair.text.empty() || observed[k].mayOverlapAtRest()) found.push_back(pair);
  }
  leaveOut(set_aside, scene);
  const OverlapNotes notes = overlapNotes(found, rule, scene);
  for (const std::string& note : {notes.set_aside, notes.checked})
    if (!note.empty()) scene.overlap_notes.push_back(note);
  return found;
}

OverlapNotes overlapNotes(const std::vector<PairDecision>& pairs, const OverlapRule& rule, const Scene& scene) {
  if (pairs.empty()) return {};
  std::set<NamePair> now_checked, now_set_aside;
  for (const PlannedPair& pair : scene.pairs) {
    const Body &a = scene.bodies[pair.body_a], &b = scene.bodies[pair.body_b];
    if (!a.is_world && !b.is_world) now_checked.insert(namePair(a.name, b.name));
  }
  for (const PairDecision& pair : scene.left_out)
    if (pair.kind >= PairKind::kAlways) now_set_aside.insert(namePair(pair.body_a, pair.body_b));
  Pairs checked, set_aside;
  for (const PairDecision& pair : pairs) {
    const NamePair names = namePair(pair.body_a, pair.body_b);
    if (now_checked.count(names) > 0) checked.push_back(pair);
    if (now_set_aside.count(names) > 0) set_aside.push_back(pair);
  }
  for (Pairs* some : {&checked, &set_aside})
    std::stable_sort(some->begin(), some->end(), [](const PairDecision& a, const PairDecision& b) {
      const auto rank = [](const PairDecision& pair) {
        return std::pair(pair.kind == PairKind::kMayAtRest, -pair.depth);
      };
      return rank(a) < rank(b);
    });
  OverlapNotes notes;
  if (!set_aside.empty())
    notes.set_aside = sentence(set_aside, "set aside") +
                      "\nTheir contacts are not seen; checked_pairs, or overlapping_pairs, has them checked. Lines for "
                      "an SRDF that make it permanent:" +
                      srdfLines(set_aside, rule);
  if (checked.empty()) return notes;
  const std::string lines = srdfLines(checked, rule);
  notes.checked =
      sentence(checked, "checked") +
      (lines.empty()
           ? "\nThis is requested."
           : "\nLines for an SRDF that set them aside, if it is known that these contacts mean nothing:" + lines);
  return notes;
}

}  // namespace sdf_ccd
