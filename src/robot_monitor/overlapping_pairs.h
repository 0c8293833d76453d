#pragma once

#include <string>
#include <vector>

#include "model/pair_rules.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// How two links are with all joints at rest: at zero, or at the nearest limit.
enum class Overlap {
  kCertain,   ///< their shapes overlap
  kTouching,  ///< neighbours whose surfaces come within 1 mm
  kOpen       ///< they may overlap: surfaces coincide or nearly so, or the inside of one is not known
};

/// Two links that overlap, touch, or may overlap at rest.
struct OverlappingPair {
  int pair = -1;  ///< in Scene::pairs
  Overlap overlap = Overlap::kCertain;
  double depth = 0.0;   ///< if certain: of the deepest point found [m]; 0 if only the surfaces show the overlap
  bool always = false;  ///< overlaps or touches also in every random state of the joints between them
};

/// Pairs of links of the scene that overlap or may overlap, and neighbours (RobotModel::neighbours()) whose surfaces
/// come within 1 mm.
/// Neighbours that come so close in some states and enter each other by more than that in others are not `always`.
/// Pairs with a planar, floating or unlimited prismatic joint between them, adjacent links, and pairs that only may
/// overlap are never `always`.
/// @param scene  bodies whose names are links; others are skipped.
/// @param states  number of random states, by JointSampler, until a pair is found apart; with 0, no pair is `always`. A
/// pair that is apart in one of a hundred states is classified as `always` in 13 % of cases with 200 states, one apart
/// in one of twenty in 0.004 %.
std::vector<OverlappingPair> overlappingPairs(const RobotModel& robot, const Scene& scene, std::size_t states = 200);

/// Which overlapping pairs are left out.
struct OverlapRule {
  bool leave_out = true;       ///< those that are `always`; if not, none
  std::vector<PairRule> kept;  ///< pairs that stay all the same
};

/// Finds overlapping pairs, tells of them in Scene::warnings, deepest first, and removes those that the rule leaves out
/// from the scene, with their depths in LeftOut::reason.
///
/// Pairs that are `always` are left out as by MoveIt's setup assistant: they would be in contact nearly always, which
/// costs most time and means nothing. That is no proof: states in which they are apart may exist. Pairs that only
/// overlap at rest stay.
void applyOverlapRule(const RobotModel& robot, const OverlapRule& rule, Scene& scene);

}  // namespace sdf_ccd
