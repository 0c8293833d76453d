#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/tf/robot_frames.h"

namespace sdf_ccd {

/// The transforms that robot_state_publisher sends for a robot: the pose of each link in its parent's frame. Planar and
/// floating joints have none.
class JointFrames {
 public:
  /// @param prefix  of the links' frames: "", or a name that ends in a slash.
  JointFrames(std::shared_ptr<const RobotModel> robot, const std::string& prefix);

  /// Frames of all links but the root, which a bag's tf may contain, and of those that are not on fixed joints; and
  /// whether the robot has a joint of this name.
  std::vector<std::string> frames() const;
  std::vector<std::string> movableFrames() const;
  bool knows(const std::string& joint) const;

  /// Frames of the links that moved() gives for a message with positions of these joints.
  std::vector<std::string> movedFrames(const std::set<std::string>& joints) const;

  /// Transforms of the links on fixed joints whose frames are wanted.
  tf2_msgs::TFMessage fixed(const ros::Time& stamp, const std::function<bool(const std::string&)>& is_wanted) const;

  /// Transforms of the links on the joints for which the message gives a position, and on those that mimic them and
  /// have none. Names that are not joints of the robot, and positions that are not finite, are ignored.
  tf2_msgs::TFMessage moved(const sensor_msgs::JointState& joints, const ros::Time& stamp) const;

 private:
  /// Of the links, but the root, whose joint above is wanted, with the joints at these positions.
  tf2_msgs::TFMessage transforms(const JointPositions& positions, const ros::Time& stamp,
                                 const std::function<bool(int link, const urdf::Joint& joint)>& is_wanted) const;

  template <class Joints>
  bool isMoved(const urdf::Joint& joint, const Joints& by) const;

  std::shared_ptr<const RobotModel> robot_;
  RobotFrames frames_;
};

}  // namespace sdf_ccd
