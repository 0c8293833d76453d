#include "overlapping_pairs.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "common/counted.h"
#include "common/number_text.h"
#include "model/name_pair.h"
#include "robot/joint_sampler.h"
#include "sdf_ccd/common/cancel.h"
#include "state_verdicts.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kNamed = 6;  // at most so many pairs are named in a warning

/// "2 pairs of links, the deepest first: l_wheel - base (46.3 mm), mast - base (within 1 mm)".
std::string listOf(std::vector<OverlappingPair> pairs, const Scene& scene) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return std::pair(a.overlap, -a.depth) < std::pair(b.overlap, -b.depth);
  });
  std::vector<std::string> texts;
  for (const OverlappingPair& pair : pairs) {
    texts.push_back(pairName(scene, scene.pairs[static_cast<std::size_t>(pair.pair)]));
    const bool touches = pair.overlap == Overlap::kTouching;
    const std::string depth = touches ? "within 1 mm" : pair.depth > 0.0 ? lengthText(pair.depth) : "";
    if (!depth.empty()) texts.back() += " (" + depth + ")";
  }
  const bool have_order = pairs.size() > 1 && pairs.front().overlap != Overlap::kOpen;
  return counted(pairs.size(), "pair") + " of links" + (have_order ? ", the deepest first: " : ": ") +
         firstOf(texts, kNamed);
}

constexpr double kTouch = 1e-3;  // how close surfaces are that joints hold together [m]

/// Whether surfaces are apart by no more than that. Where nothing is known of the inside, as in an open mesh, the error
/// is larger.
bool touch(const PairResult& pair) {
  return (pair.verdict == Verdict::kUncertain && pair.error.total() <= kTouch) ||
         (pair.verdict == Verdict::kClear && pair.clearance <= kTouch);
}

/// @param verdict  as judged at rest: CONTACT, UNCERTAIN or NOT_CHECKED.
Overlap overlapOf(Verdict verdict) {
  return verdict == Verdict::kContact     ? Overlap::kCertain
         : verdict == Verdict::kUncertain ? Overlap::kTouching
                                          : Overlap::kOpen;
}

/// In which states a pair was seen.
struct StatesSeen {
  bool touches = false;                  ///< apart by no more than kTouch in some state
  std::vector<JointPositions> contacts;  ///< some of the states in which it overlaps

  void add(Verdict verdict, const JointPositions& state) {
    constexpr std::size_t kMost = 20;
    touches |= verdict == Verdict::kUncertain;
    if (verdict == Verdict::kContact && contacts.size() < kMost) contacts.push_back(state);
  }
};

/// Whether the bodies surely enter each other by more than they may touch in one of the states: such a pair, which is
/// apart in others, is not held together by its joint, but hits a stop.
bool entersIn(const RobotModel& robot, const Scene& scene, std::size_t pair,
              const std::vector<JointPositions>& states) {
  const auto judge = [](const PairResult& result) {
    return result.deepest.depth - result.deepest.depth_error > kTouch ? Verdict::kContact : Verdict::kClear;
  };
  return std::any_of(states.begin(), states.end(), [&](const JointPositions& state) {
    return pairsIn(robot, scene, {pair}, state, judge).front().verdict == Verdict::kContact;
  });
}

}  // namespace

std::vector<OverlappingPair> overlappingPairs(const RobotModel& robot, const Scene& scene, std::size_t states) {
  const auto linkOf = [&](int body) {
    const Body& of = scene.bodies[static_cast<std::size_t>(body)];
    return of.is_world || !of.failure.empty() ? -1 : robot.find(of.name);
  };
  std::vector<std::size_t> tested;
  for (std::size_t p = 0; p < scene.pairs.size(); ++p)
    if (linkOf(scene.pairs[p].body_a) >= 0 && linkOf(scene.pairs[p].body_b) >= 0) tested.push_back(p);
  if (tested.empty()) return {};

  // CONTACT, UNCERTAIN (neighbours that touch), or CLEAR.
  const auto judge = [&](const PairResult& pair) {
    const std::string &a = scene.bodies[pair.body_a].name, &b = scene.bodies[pair.body_b].name;
    if (pair.verdict == Verdict::kContact) return Verdict::kContact;
    return touch(pair) && robot.neighbours(a, b) ? Verdict::kUncertain : Verdict::kClear;
  };
  // Or NOT_CHECKED, if nothing tells.
  const auto judgeAtRest = [&](const PairResult& pair) {
    const Verdict verdict = judge(pair);
    return verdict == Verdict::kClear && pair.verdict == Verdict::kUncertain ? Verdict::kNotChecked : verdict;
  };
  std::vector<OverlappingPair> found;
  const std::vector<PairAtRest> at_rest = pairsIn(robot, scene, tested, JointPositions(), judgeAtRest);
  std::vector<std::size_t> open;  // of scene.pairs
  for (std::size_t k = 0; k < tested.size(); ++k) {
    if (at_rest[k].verdict == Verdict::kClear) continue;
    const PlannedPair& pair = scene.pairs[tested[k]];
    const int a = linkOf(pair.body_a), b = linkOf(pair.body_b);
    const Overlap overlap = overlapOf(at_rest[k].verdict);
    found.push_back(
        {static_cast<int>(tested[k]), overlap, overlap == Overlap::kCertain ? at_rest[k].depth : 0.0, false});
    if (overlap == Overlap::kOpen) continue;
    const bool adjacent = robot.adjacent(scene.bodies[pair.body_a].name, scene.bodies[pair.body_b].name);
    if (states > 0 && !adjacent && JointSampler::unboundedBetween(robot, a, b).empty()) open.push_back(tested[k]);
  }

  JointSampler sampler(robot, 1);
  constexpr std::size_t kFirst = 8;  // most pairs that separate do so early
  std::map<std::size_t, StatesSeen> seen;
  for (std::size_t k = 0; k < tested.size(); ++k) seen[tested[k]].add(at_rest[k].verdict, {});
  for (std::size_t drawn = 0; drawn < states && !open.empty();) {
    checkCancelled();
    const std::size_t round = std::min(states - drawn, drawn == 0 ? kFirst : 3 * drawn);
    std::vector<JointPositions> positions;
    for (std::size_t i = 0; i < round; ++i) positions.push_back(sampler.next());
    drawn += round;
    const std::vector<Verdict> verdicts = verdictsOf(robot, scene, open, positions, judge);
    std::vector<std::size_t> still_open;
    for (std::size_t k = 0; k < open.size(); ++k) {
      bool is_open = true;
      for (std::size_t i = 0; i < round && is_open; ++i) {
        const Verdict verdict = verdicts[i * open.size() + k];
        is_open = verdict != Verdict::kClear;
        seen[open[k]].add(verdict, positions[i]);
      }
      if (is_open) still_open.push_back(open[k]);
    }
    open = std::move(still_open);
  }
  open.erase(
      std::remove_if(open.begin(), open.end(),
                     [&](std::size_t p) { return seen[p].touches && entersIn(robot, scene, p, seen[p].contacts); }),
      open.end());
  for (OverlappingPair& pair : found)
    pair.always = std::find(open.begin(), open.end(), static_cast<std::size_t>(pair.pair)) != open.end();
  return found;
}

void applyOverlapRule(const RobotModel& robot, const OverlapRule& rule, Scene& scene) {
  constexpr std::size_t kStates = 200;
  const std::string states = "in all of " + std::to_string(kStates) + " random states";
  std::vector<OverlappingPair> left_out, checked, kept, open;
  std::vector<LeftOutReason> reasons(scene.pairs.size());
  for (const OverlappingPair& pair : overlappingPairs(robot, scene, rule.leave_out ? kStates : 0)) {
    if (pair.overlap == Overlap::kOpen) {
      open.push_back(pair);
      continue;
    }
    const PlannedPair& planned = scene.pairs[static_cast<std::size_t>(pair.pair)];
    const bool stays = matchesAny(rule.kept, scene.bodies[planned.body_a].name, scene.bodies[planned.body_b].name);
    (stays ? kept : pair.always ? left_out : checked).push_back(pair);
    if (stays || !pair.always) continue;
    const std::string reason = pair.overlap == Overlap::kTouching
                                   ? "come within 1 mm as neighbours at rest, and overlap or come within 1 mm " + states
                                   : "overlap at rest and overlap or, as neighbours, come within 1 mm " + states;
    reasons[static_cast<std::size_t>(pair.pair)] = {reason + ", which is no proof for others", pair.depth};
  }
  const std::string overlap = "overlap, or as neighbours come within 1 mm, ";
  if (!left_out.empty())
    scene.warnings.push_back("left out, as they " + overlap + "at rest and " + states +
                             ", which is no proof for others (depth at rest of the deepest point found): " +
                             listOf(left_out, scene) + "; list them in checked_pairs to check them");
  if (!checked.empty())
    scene.warnings.push_back(overlap + "where all joints are at rest, and are checked: " + listOf(checked, scene) +
                             "; allowed_pairs leaves them out");
  if (!kept.empty())
    scene.warnings.push_back(overlap +
                             "where all joints are at rest, and are checked as checked_pairs, or the SRDF's " +
                             "enable_collisions, says: " + listOf(kept, scene));
  if (!open.empty())
    scene.warnings.push_back("may overlap where all joints are at rest, as far as can be told, and are checked: " +
                             listOf(open, scene));
  leaveOut(reasons, scene);
}

}  // namespace sdf_ccd
