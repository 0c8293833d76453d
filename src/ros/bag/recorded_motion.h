#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <rosbag/bag.h>

#include "ros/bag/joint_frames.h"
#include "ros/tf/joint_watch.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd {

struct RecordedMotionOptions {
  double start = 0.0;                                         ///< [s] from the bag's first message
  double duration = std::numeric_limits<double>::infinity();  ///< [s] from there
  std::string joint_states;  ///< topic of joint states; empty: joint_states, else the only one of their type
};

/// Transforms, and when they were recorded.
struct RecordedTransforms {
  ros::Time recorded;
  tf2_msgs::TFMessage message;
  bool is_static = false;
};

/// How a bag says that a robot moved: by tf, or, where tf names none of its links, by joint states, from which
/// transforms are made as robot_state_publisher makes them. Links on fixed joints that tf does not name are where the
/// URDF puts them.
class RecordedMotion {
 public:
  /// Finds out which frames the bag names; reads it until all that are wanted are found.
  /// @throws std::runtime_error that names the bag, if it is missing, empty, damaged or not indexed, or says nothing of
  /// the robot's links or the fixed frame.
  RecordedMotion(const std::string& file, const DescribedScene& described, const RecordedMotionOptions& options);

  ros::Time begin() const { return begin_; }
  ros::Time end() const { return end_; }

  /// "tf", "tf, and the URDF for 3 fixed links", "/joint_states"
  std::string source() const;

  /// Hands over all transforms in the order of their recording, first of all those static ones that were recorded
  /// before the begin.
  /// @throws std::runtime_error that names the bag, if it is damaged.
  void play(const std::function<void(const RecordedTransforms&)>& each) const;

  /// What is wrong with the joint states that were played: positions that are not finite, which are passed over, and
  /// joints of the robot that none of them names.
  std::vector<std::string> warnings() const;

 private:
  void findTopics();
  void findFrames(const DescribedScene& described);
  void requireJointStates(const std::string& why);
  void playMessage(const rosbag::MessageInstance& message,
                   const std::function<void(const RecordedTransforms&)>& each) const;

  std::string file_;
  RecordedMotionOptions options_;
  JointFrames joints_;
  mutable JointWatch joint_watch_;         // of what was played
  mutable std::set<std::string> unnamed_;  // joints that move by themselves, and that nothing that was played names
  rosbag::Bag bag_;
  ros::Time begin_, end_;
  std::vector<std::string> tf_topics_;           // /tf and /tf_static, those that are there
  std::vector<std::string> joint_state_topics_;  // all of the type; then the one that is followed, or none
  std::set<std::string> tf_frames_;              // that tf places in another, as far as was looked
  std::size_t fixed_links_ = 0;                  // that the URDF places
};

}  // namespace sdf_ccd
