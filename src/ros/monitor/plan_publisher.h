#pragma once

#include <functional>
#include <mutex>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/world/checked_world.h"

namespace sdf_ccd {

/// Publishes, below the node's name:
///   plan  sdf_ccd/Plan  which pairs are checked, which are left out and why, for each version of the world; latched
class PlanPublisher {
 public:
  explicit PlanPublisher(ros::NodeHandle private_node);

  /// From now on at most one plan a second is published: a live map makes many versions.
  /// @param node   its callback queue calls `again`.
  /// @param again  publishes the present version of the world; called when a plan has been held back for long enough.
  void limitRate(const ros::NodeHandle& node, const std::function<void()>& again);

  /// May be called from any thread.
  void publish(const CheckedWorld& world, const std::string& fixed_frame);

 private:
  ros::Publisher publisher_;
  std::mutex mutex_;
  ros::WallTime published_;  // time of the last plan; 0 before the first
  ros::WallTimer timer_;     // publishes the last of several versions
};

}  // namespace sdf_ccd
