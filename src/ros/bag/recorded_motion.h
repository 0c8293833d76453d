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

/// Transforms, and the time at which they were recorded.
struct RecordedTransforms {
  ros::Time recorded;
  tf2_msgs::TFMessage message;
  bool is_static = false;
};

/// The motion of a robot that a bag recorded: from tf and, for links that joints move and tf does not contain, from
/// joint states, which are converted to transforms as by robot_state_publisher. If a topic of joint states is chosen,
/// it takes precedence over tf. Links on fixed joints that are not in tf have the poses of the URDF.
class RecordedMotion {
 public:
  /// Finds the frames in the bag; reads it until all frames that are needed are found.
  /// @throws std::runtime_error that names the bag, if it is missing, empty, damaged or not indexed, or contains
  /// nothing about the robot's links or the fixed frame.
  RecordedMotion(const std::string& file, const DescribedScene& described, const RecordedMotionOptions& options);

  ros::Time origin() const { return origin_; }  ///< the bag's first message; times in reports count from here
  ros::Time begin() const { return begin_; }
  ros::Time end() const { return end_; }

  /// "tf", "tf, /joint_states for 2 links, and the URDF for 3 fixed links", "/joint_states"
  std::string source() const;

  /// Passes all transforms to `each` in the order of their recording, but first the static ones that were recorded
  /// before begin().
  /// @throws std::runtime_error that names the bag, if it is damaged.
  void play(const std::function<void(const RecordedTransforms&)>& each) const;

  /// Problems of the joint states that were played: positions that are not finite, which were ignored, and joints of
  /// the robot that neither a message nor tf names; or why none were played, though tf lacks links.
  std::vector<std::string> warnings() const;

 private:
  void findTopics();
  void findFrames(const DescribedScene& described);
  void chooseJointStates(const DescribedScene& described, const std::vector<std::string>& movable, bool has_tf);
  std::string findJointStates();  // sets the topic and joint_frames_, or returns why there is none
  void playMessage(const rosbag::MessageInstance& message,
                   const std::function<void(const RecordedTransforms&)>& each) const;

  std::string file_;
  RecordedMotionOptions options_;
  JointFrames joints_;
  mutable JointWatch joint_watch_;         // of the messages played
  mutable std::set<std::string> unnamed_;  // joints that move independently and are named in no message played
  rosbag::Bag bag_;
  ros::Time origin_, begin_, end_;
  std::vector<std::string> tf_topics_;           // /tf and /tf_static, if present
  std::vector<std::string> joint_state_topics_;  // all of the type; later the one that is used, or none
  std::set<std::string> tf_frames_;              // child frames in tf, as far as the bag was read
  std::set<std::string> joint_frames_;           // frames of links that follow the joint states
  bool is_by_joints_ = false;                    // all links that joints move follow them, as far as these are named
  std::string lacking_;                          // links that tf lacks, and why joint states do not give them
  std::size_t fixed_links_ = 0;                  // number of links with the pose of the URDF
};

}  // namespace sdf_ccd
