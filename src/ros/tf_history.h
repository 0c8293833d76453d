#pragma once

#include <deque>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include "sdf_ccd/geometry/eigen_types.h"

namespace sdf_ccd {

/// Without leading slashes: tf2 strips them on arrival but refuses them in look-ups.
std::string withoutLeadingSlash(const std::string& frame);

/// The transforms of the last seconds, and at which times they were recorded.
///
/// tf2 keeps and interpolates the transforms but does not tell when they were recorded, and a cycle needs to know. So
/// this takes the place of tf2_ros::TransformListener: what is in the buffer is in the record too. Thread-safe.
class TfHistory {
 public:
  explicit TfHistory(const std::string& fixed_frame);

  const std::string& fixedFrame() const { return fixed_frame_; }

  /// Takes over a message of /tf or /tf_static. A transform more than a second older than the newest of the same
  /// frame clears everything but static transforms first.
  void add(const tf2_msgs::TFMessage& message, bool is_static);

  /// Watches the ROS clock, 0 if it does not run yet. A clock that goes back clears everything but static transforms.
  void watchClock(const ros::Time& now);

  /// True once after time has jumped back.
  bool takeJump();

  /// What is known of the way from the fixed frame to a frame.
  struct Span {
    std::string problem;  ///< why there is no way; empty if there is one
    bool is_static = false;
    ros::Time first, last;  ///< known from when to when; not set if static
  };
  Span span(const std::string& frame) const;

  /// The same of several frames, all before or all after a message that is being added.
  std::vector<Span> spans(const std::vector<std::string>& frames) const;

  /// Adds the times within (start, end) at which the way to the frame has a recorded transform that differs from its
  /// neighbours: between all others it rests.
  void recordedTimes(const std::string& frame, const ros::Time& start, const ros::Time& end,
                     std::vector<ros::Time>& times) const;

  /// Longest time between two recorded transforms of one joint on the way, of those that overlap (start, end) [s].
  double longestGap(const std::string& frame, const ros::Time& start, const ros::Time& end) const;

  /// Pose of the frame in the fixed frame, as tf2 interpolates it; time 0 is the latest. False, with the reason, if
  /// it is not known: nothing is extrapolated.
  bool lookup(const std::string& frame, const ros::Time& time, Isometry3d& X_WF, std::string& problem) const;
  bool lookup(const std::string& target, const std::string& frame, const ros::Time& time, Isometry3d& X_TF,
              std::string& problem) const;

  /// The frames above a frame, the nearest first.
  std::vector<std::string> framesAbove(const std::string& frame) const;

  /// Transforms that came behind newer ones of the same frame: cycles may have used an interpolation in their place.
  long outOfOrder() const;

 private:
  struct Record {
    ros::Time stamp;
    bool differs;  // from the one before
  };
  struct Edge {  // from a frame to its parent
    std::string parent;
    bool is_static = false;
    std::deque<Record> records;
    geometry_msgs::Transform newest;
  };

  void addOne(const geometry_msgs::TransformStamped& transform, bool is_static);
  void record(Edge& edge, const geometry_msgs::TransformStamped& transform);
  void clear();
  Span lockedSpan(const std::string& frame) const;
  bool chain(const std::string& frame, std::vector<const Edge*>& edges, std::string& problem) const;
  std::vector<const Edge*> edgesUpwards(const std::string& frame) const;
  std::string rootOf(const std::string& frame) const;

  const std::string fixed_frame_;
  tf2::BufferCore buffer_;
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Edge> edges_;  // by child frame
  ros::Time clock_;
  bool jumped_ = false;
  long out_of_order_ = 0;
};

}  // namespace sdf_ccd
