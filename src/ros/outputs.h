#pragma once

#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "ros/link_markers.h"
#include "ros/markers.h"
#include "ros/monitor_loop.h"

namespace sdf_ccd {

/// Publishes what a cycle found.
///
/// Publishes, below the node's name:
///   contacts         sdf_ccd/ContactArray            every cycle, and once a second while there is none
///   wrenches/<link>  geometry_msgs/WrenchStamped     every cycle: sum of the contact wrenches on the link, in the
///                                                    link's frame, about its origin [N, N·m]
///   markers          visualization_msgs/MarkerArray  contacts and status to look at
///   links            visualization_msgs/MarkerArray  the links' collision shapes in the colours of their verdicts, all
///                                                    of them when one changes; latched
/// Nothing is put together, or computed, that has no subscriber.
class Outputs {
 public:
  Outputs(ros::NodeHandle private_node, const MonitorLoop& loop, const SceneDescription& scene,
          const MarkerOptions& options);

  /// What the subscribers want to know of the next cycle.
  CycleRequest request(int max_points) const;

  /// Of the loop's last cycle.
  void publish();

  /// Nothing is checked after the last cycle, for this reason: a message without pairs, and no markers.
  void publishUnchecked(const std::string& reason);

 private:
  struct LinkWrench {
    int body;
    ros::Publisher publisher;
  };

  void publishWrenches() const;
  void publishMarkers();

  const MonitorLoop& loop_;
  MarkerDrawer drawer_;
  LinkMarkers link_markers_;
  ros::Publisher contacts_, markers_, links_;
  std::vector<LinkWrench> wrenches_;
};

}  // namespace sdf_ccd
