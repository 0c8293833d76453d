#pragma once

#include <cstdint>
#include <functional>
#include <memory>
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

  /// From now on publishes at most one plan a second, and publish() does nothing: a live map makes many versions, and
  /// does not wait for their plans.
  /// @param node   whose callback queue calls `world`.
  /// @param world  returns the present version.
  void limitRate(const ros::NodeHandle& node, std::function<std::shared_ptr<const CheckedWorld>()> world,
                 const std::string& fixed_frame);

  /// To be called by one thread at a time.
  void publish(const CheckedWorld& world, const std::string& fixed_frame);

 private:
  void send(const CheckedWorld& world, const std::string& fixed_frame);

  ros::Publisher publisher_;
  std::uint64_t version_ = 0;  // the last one sent
  ros::WallTimer timer_;       // null: the rate is not limited
};

}  // namespace sdf_ccd
