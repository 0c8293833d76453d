#pragma once

#include <string>
#include <vector>

#include "model/pair_rules.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// Two links whose shapes overlap with all joints at rest: at zero, or at the nearest limit.
struct OverlappingPair {
  int pair = -1;        ///< in Scene::pairs
  double depth = 0.0;   ///< of the deepest point found [m]; 0 if only the surfaces show the overlap
  bool always = false;  ///< also in every random state of the joints between them
};

/// Overlapping pairs of links of the scene, and neighbours (RobotModel::neighbours()) whose surfaces come within 1 mm.
/// Neighbours that come so close in some states and enter each other by more than that in others are not `always`.
/// Pairs with a planar, floating or unlimited prismatic joint between them, and adjacent links, are never `always`.
/// @param scene  bodies whose names are links; others are skipped.
/// @param states  number of random states, by JointSampler, until a pair is found apart: a pair that is apart in one of
/// a hundred states is classified as `always` in 13 % of cases with 200 states, one apart in one of twenty in 0.004 %.
std::vector<OverlappingPair> overlappingPairs(const RobotModel& robot, const Scene& scene, std::size_t states = 200);

/// Removes the pairs that are `always` from the scene, as MoveIt's setup assistant does: they would be in contact
/// nearly always, which costs most time and means nothing. That is no proof: states in which they are apart may exist.
/// Pairs that only overlap at rest stay. Scene::warnings lists both.
/// @param kept  pairs that always stay.
void leaveOutOverlapping(const RobotModel& robot, const std::vector<PairRule>& kept, Scene& scene);

}  // namespace sdf_ccd
