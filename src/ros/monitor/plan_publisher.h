#pragma once

#include <functional>
#include <mutex>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/world/checked_world.h"

namespace sdf_ccd {

/// Publishes, below the node's name:
///   plan  sdf_ccd/Plan  what is checked against what, and what is left out and why, anew for each version of the
///                       world; latched
class PlanPublisher {
 public:
  explicit PlanPublisher(ros::NodeHandle private_node);

  /// From now on at most one plan a second is published: a live map makes many versions.
  /// @param node   whose callback queue is to call `again`.
  /// @param again  publishes the world's present version; called when a plan has been held back for long enough.
  void limitRate(const ros::NodeHandle& node, const std::function<void()>& again);

  /// From any thread.
  void publish(const CheckedWorld& world, const std::string& fixed_frame);

 private:
  ros::Publisher publisher_;
  std::mutex mutex_;
  ros::WallTime published_;  // the last one; 0 before
  ros::WallTimer timer_;     // for the last one of several
};

}  // namespace sdf_ccd
