#pragma once

#include <memory>
#include <string>
#include <vector>

#include "robot/proof_watch.h"
#include "ros/tf/tf_tracker.h"
#include "ros/world/checked_world.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd {

/// Checks the assumptions behind pairs that were left out as out of reach or rigidly joined: that prismatic joints keep
/// approximately to their limits (RobotModel::reach()), and that tf has the links, and the objects that are at rest
/// relative to the robot's root, where the URDF's joints can have them.
class ReachGuard {
 public:
  /// @param world  whose pairs are checked; must outlive this.
  /// @param robot  and its frames in tf.
  ReachGuard(const CheckedWorld& world, const DescribedScene& robot);

  /// The pairs for which this does not hold in the part of the cycle over which they are watched, or whose joints are
  /// not known in tf.
  std::vector<UncheckedPair> check(const TfHistory& history, const TrackedCycle& cycle);

 private:
  struct Joint {
    SlideRange slide;
    const urdf::Joint* joint;
    ros::Time until;      // it was looked at up to here
    std::string problem;  // in the last cycle
  };

  void copyJoints(const TfHistory& history, const TrackedCycle& cycle);
  std::string problem(std::size_t joint);
  std::string notWatched(const TfHistory& history, const TrackedCycle& cycle, std::size_t pair) const;

  const CheckedWorld& world_;
  std::shared_ptr<const RobotModel> robot_;
  ProofWatch watch_;
  std::vector<bool> is_checked_;                  // per body: is in a pair that is checked
  std::vector<std::vector<std::size_t>> slides_;  // per pair: in joints_, which must keep to their ranges
  std::vector<Joint> joints_;
  TfChains chains_;  // to each joint's parent and child
  std::vector<TfSpan> spans_;
  std::vector<TimePart> parts_;
  TfWindow window_;
  std::vector<std::size_t> frames_;       // of one joint, in window_
  std::vector<double> times_, recorded_;  // of that joint
};

}  // namespace sdf_ccd
