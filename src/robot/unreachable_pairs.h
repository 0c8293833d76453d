#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/proofs.h"
#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/robot/planned_motion.h"
#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd {

/// Whether the bodies of a pair that is rigidly joined are where the URDF has them, but for rounding and calibration:
/// no point of one of them moves by more than a millimetre in the other's frame.
bool areJoinedAt(const UnreachablePair& pair, const Isometry3d& X_AB);

/// Why pairs that assume this range are not out of reach with the joint at this position; empty if they are.
std::string beyondReach(const SlideRange& slide, double position);

/// Those pairs that no rule of the user allows to touch; nobody needs to watch the others.
std::vector<UnreachablePair> withoutAllowed(std::vector<UnreachablePair> pairs, const SceneDescription& scene);

/// Sets the proofs of the pairs that are AllowedPair::proved and have none yet, from how the URDF joins their links.
/// @param bodies  of the scene.
/// @param prefix  of the frames of links, where these are not the links' names.
void addProofs(const RobotModel& robot, const std::vector<BodyDescription>& bodies, std::vector<AllowedPair>& allowed,
               const std::string& prefix = {});

/// Tells of pairs that are left out whether the robot's joints can bring them together along a plan.
class JointReach {
 public:
  JointReach(const RobotModel& robot, const PlannedJoints& plan, const std::vector<CarriedBody>& bodies);

  /// Why the pair may meet, or move relative to each other: a prismatic joint leaves the assumed range or is not known,
  /// or a body is not carried by the robot. Empty if that is certainly not so. Between two waypoints positions lie
  /// between those at both.
  std::string whyReachable(const UnreachablePair& pair) const;

 private:
  /// Where a prismatic joint is along the plan [m].
  struct Range {
    double low, high;
    bool is_known;
  };

  std::map<std::string, Range> ranges_;  // by prismatic joint
  std::vector<int> group_;  // per body: the first link that is rigidly joined to its link; −1 if none carries it
};

/// The same for bodies that move independently of joints: their balls may meet, or they are not where they are rigidly
/// joined. Conservative: for two balls that pass each other only the lengths of their displacements are used.
/// @param motion  CycleMotion::missing must be set. @param is_moved  per body; of a pair without such a body nothing is
/// examined.
std::string whyReachable(const CycleMotion& motion, const std::vector<bool>& is_moved, const UnreachablePair& pair);

}  // namespace sdf_ccd
