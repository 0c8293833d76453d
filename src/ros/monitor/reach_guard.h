#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros/tf/tf_tracker.h"
#include "ros/world/checked_world.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd {

/// Checks the assumptions behind pairs that were left out as out of reach: that prismatic joints keep approximately to
/// their limits (RobotModel::reach()), and that tf has the links where the URDF's joints can move them.
class ReachGuard {
 public:
  /// @param world  whose pairs are checked; must outlive this.
  /// @param robot  and its frames in tf.
  ReachGuard(const CheckedWorld& world, const DescribedScene& robot);

  /// The pairs for which this does not hold at some recorded time of the cycle, or whose joints are not known in tf.
  std::vector<UncheckedPair> check(const TfHistory& history, const TrackedCycle& cycle);

 private:
  struct Joint {
    RobotModel::Slide slide;
    const urdf::Joint* joint;
    std::string problem;  // in the last cycle
  };

  /// Finds the waypoints at which a body's poses are those of tf, from its checked pairs.
  void findSpans(const CycleMotion& motion);
  void findTouchingBalls(const CycleMotion& motion, std::vector<UncheckedPair>& unchecked) const;
  void copyJointMotion(const TfHistory& history, const TrackedCycle& cycle);
  std::string problem(std::size_t joint, const TrackedCycle& cycle);

  const Scene& scene_;
  std::shared_ptr<const RobotModel> robot_;
  std::vector<Joint> joints_;
  TfChains chains_;  // to each joint's parent and child
  std::vector<TfSpan> spans_;
  std::vector<TimePart> parts_;
  TfWindow window_;
  std::vector<UncheckedPair> pairs_;                      // without reasons
  std::vector<std::vector<std::size_t>> joints_of_pair_;  // per pair: indices of joints
  std::vector<UnreachablePair> unreachable_;  // links only: objects may be out of reach though their balls meet
  std::vector<bool> is_checked_;              // per body: whether it is in a pair
  std::vector<WaypointSpan> known_;           // per body, in the last cycle
};

}  // namespace sdf_ccd
