#pragma once

#include <string>
#include <vector>

#include "scene/pair_rules.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Which pairs of links that overlap at rest are set aside.
struct OverlapRule {
  enum class Kind {
    kNeighbours,  ///< those that surely overlap at rest, with at most two movable joints between them; and kLeaveOut
    kRest,        ///< all that overlap or may overlap at rest, as by MoveIt's setup assistant
    kLeaveOut,    ///< those that overlap, or as neighbours touch, also in all random states
    kCheck        ///< none
  };
  Kind kind = Kind::kNeighbours;
  std::vector<PairRule> kept;  ///< pairs that stay all the same
};

/// The rule that keeps the given pairs, and those that an SRDF enables.
OverlapRule overlapRule(OverlapRule::Kind kind, const Srdf& srdf, std::vector<PairRule> kept = {});

/// Finds pairs of links that overlap, touch as neighbours, or may overlap at rest, and removes those from the scene
/// that the rule sets aside: they would be in contact nearly always, which costs most time and says little. That is no
/// proof: contacts of these pairs are not seen.
///
/// `Always` is tested in 200 random states, drawn as by JointSampler. A pair that is apart in one of a hundred states
/// is taken for one that overlaps always in 13 % of cases, one apart in one of twenty in 0.004 %. Adjacent links, which
/// are in the scene only by request, always stay; so do pairs with a planar, floating or unlimited prismatic joint
/// between them, except by kRest.
/// @param scene  bodies whose names are links; others are skipped. Its left_out gets those that are set aside, its
/// overlap_notes tell of all.
/// @return all of them, of kAlways, kHeld, kAtRest or kMayAtRest; with a text if they are set aside.
std::vector<PairDecision> applyOverlapRule(const RobotModel& robot, const OverlapRule& rule, Scene& scene);

/// What the user must know of pairs that overlap at rest, the deepest first: "3 pairs that overlap at rest are set
/// aside: wheel - base (30 mm), ...", with the lines of an SRDF that make it permanent; the same of those that are
/// checked, with the lines that would set them aside. Each is empty if there is none.
struct OverlapNotes {
  std::string set_aside, checked;
};

/// @param pairs  of applyOverlapRule() with this rule; as they are in this version of their scene, as requests may have
/// had pairs checked, or left out for other reasons.
OverlapNotes overlapNotes(const std::vector<PairDecision>& pairs, const OverlapRule& rule, const Scene& scene);

}  // namespace sdf_ccd
