#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ros/tf/tf_tracker.h"
#include "ros/world/checked_world.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd {

/// Watches what pairs that were left out as out of reach rest on: that prismatic joints keep to their limits, by and
/// large (RobotModel::reach()), and that tf has the links where the URDF's joints can take them.
class ReachGuard {
 public:
  /// @param world  whose pairs are checked; must outlive this.
  /// @param robot  with its frames in tf.
  ReachGuard(const CheckedWorld& world, const DescribedScene& robot);

  /// The pairs that this does not hold for at some recorded time of the cycle, or whose joints tf does not have.
  std::vector<UncheckedPair> check(const TfHistory& history, const TrackedCycle& cycle);

 private:
  struct Joint {
    RobotModel::Slide slide;
    const urdf::Joint* joint;
    std::string problem;  // in the last cycle
  };

  /// The waypoints of a body whose poses are those of tf, from a checked pair of it.
  void findSpans(const CycleMotion& motion);
  void findNear(const CycleMotion& motion, std::vector<UncheckedPair>& unchecked) const;
  void follow(const TfHistory& history, const TrackedCycle& cycle);
  std::string problem(std::size_t joint, const TrackedCycle& cycle);

  const Scene& scene_;
  std::shared_ptr<const RobotModel> robot_;
  std::vector<Joint> joints_;
  TfChains chains_;  // to each joint's parent and child
  std::vector<TfSpan> spans_;
  std::vector<TimePart> parts_;
  TfWindow window_;
  std::vector<UncheckedPair> pairs_;               // each with no reason yet
  std::vector<std::vector<std::size_t>> rest_on_;  // per pair: joints
  std::vector<UnreachablePair> unreachable_;  // of links: objects may be out of reach though balls around them meet
  std::vector<bool> is_checked_;              // per body: it is in a pair
  std::vector<WaypointSpan> known_;           // per body, in the last cycle
};

}  // namespace sdf_ccd
