#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ros/monitor/robot_in_map.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

/// Finds out whether a map's frame has moved, so that its voxels are elsewhere now: a localisation was corrected, or
/// the robot carries the frame. That the robot drives through the map is no such motion. So a frame above the fixed
/// frame in tf is compared with the frame below it on the way there, where localisation is corrected ("map" with
/// "odom"), unless that one is the robot's own; any other frame with the fixed frame.
class MapFrameWatch {
 public:
  /// @param root_frame  of the robot.
  MapFrameWatch(const TfHistory& history, std::string root_frame)
      : history_(history), root_frame_(std::move(root_frame)) {}

  /// Whether the frame is elsewhere than when this last returned true, or first knew it, by more than this distance at
  /// one of the robot's bodies [m]. False if that is not known.
  bool hasMoved(const std::string& frame, const ros::Time& stamp, const std::vector<BodyInMap>& bodies,
                double distance);

  /// Whether the frame has moved with the robot, or whatever else it is below in tf: no localisation was corrected.
  bool isCarried() const { return is_carried_; }

 private:
  std::string reference(const std::string& frame) const;

  const TfHistory& history_;
  std::string root_frame_, frame_, reference_;
  std::optional<Isometry3d> X_RM_;  // pose of the frame in the reference
  bool is_carried_ = false;
};

}  // namespace sdf_ccd
