#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

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

  /// The pairs for which this does not hold at some recorded time of the cycle (but its first, which the cycle before
  /// had), or whose joints are not known in tf.
  std::vector<UncheckedPair> check(const TfHistory& history, const TrackedCycle& cycle);

 private:
  struct Joint {
    RobotModel::Slide slide;
    const urdf::Joint* joint;
    std::string problem;  // in the last cycle
  };

  /// A body of pairs that were left out.
  struct Guarded {
    std::size_t body;
    int frame = -1;  // in chains_, of a body that is in no checked pair, so that its motion is not in the cycle's
    BoundingBall ball;
    int joined_to = -1;  // another one of its rigid group; -1 for the group's first
    Isometry3d X_AB;     // in that one
    bool is_known = false;
    Isometry3d X_WB;   // if known, at the time that is looked at
    Vector3d p_WBall;  // its ball's centre
  };

  struct GuardedPair {
    std::size_t a, b;  // in guarded_
    const UnreachablePair* pair;
    double reach = 0.0;                    // sum of the balls' radii [m]
    std::vector<std::size_t> joints = {};  // in joints_, which must keep to their ranges
    bool is_reported = false;
  };

  void addGuarded(const UnreachablePair& pair, std::vector<int>& index);
  std::pair<std::size_t, Isometry3d> groupOf(std::size_t body) const;
  void copyMotion(const TfHistory& history, const TrackedCycle& cycle);
  static void report(GuardedPair& pair, const std::string& reason, std::vector<UncheckedPair>& unchecked);
  void checkPoses(const CycleMotion& motion, std::vector<UncheckedPair>& unchecked);
  void checkJoints(const TrackedCycle& cycle, std::vector<UncheckedPair>& unchecked);
  void findSpans(const CycleMotion& motion);
  void place(const CycleMotion& motion, std::size_t waypoint);
  bool areJoined() const;
  bool mayMeet(const GuardedPair& pair) const;
  std::string problem(std::size_t joint, const TrackedCycle& cycle);

  const CheckedWorld& world_;
  std::shared_ptr<const RobotModel> robot_;
  std::vector<Joint> joints_;
  TfChains chains_;  // to each joint's parent and child, then to guarded bodies that are in no checked pair
  std::vector<TfSpan> spans_;
  std::vector<TimePart> parts_;
  std::vector<Interval> known_parts_;  // per part [s] from the origin
  TfWindow window_;
  std::vector<Guarded> guarded_;
  std::vector<GuardedPair> apart_, joined_;
  std::vector<WaypointSpan> known_;  // per body, in the last cycle
};

}  // namespace sdf_ccd
