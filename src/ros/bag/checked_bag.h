#pragma once

#include <map>
#include <string>

#include "ros/bag/bag_writer.h"
#include "ros/bag/recorded_motion.h"
#include "ros/messages/link_markers.h"
#include "ros/messages/markers.h"
#include "ros/monitor/cycle_messages.h"

namespace sdf_ccd {

/// Writes what a check found to a bag, with the transforms it was found from, so that rviz shows it as if live.
///
/// /tf, /tf_static  tf2_msgs/TFMessage  as they were followed
/// Below /collision_monitor/, as the nodelet publishes them:
///   contacts         sdf_ccd/ContactArray            every cycle, when there begin to be none, and of each gap
///   state            sdf_ccd/MonitorState            the same
///   wrenches/<link>  geometry_msgs/WrenchStamped     every cycle in which the link is in contact
///   markers          visualization_msgs/MarkerArray  contacts and status to look at
///   links            visualization_msgs/MarkerArray  when a link's verdict changes
///   plan, world      once
class CheckedBag {
 public:
  /// @param bag    open, and empty; closed by whoever opened it. It throws where it cannot be written.
  /// @param loop   is asked for each cycle. Both must outlive this.
  /// @param scene  what the loop's was built from.
  CheckedBag(BagWriter& bag, const MonitorLoop& loop, const SceneDescription& scene, const MarkerOptions& markers);

  /// The plan and the world, at the bag's begin.
  void addScene(const SceneDescription& description, const ros::Time& begin);

  void addTransforms(const RecordedTransforms& transforms);

  /// The loop's last cycle.
  void addCycle(const ContactArray& contacts, const ros::Time& now);

  /// Nothing is checked after the last cycle: no markers, and messages that say so.
  void addUnchecked(const std::string& reason, const ros::Time& now);

  /// toGap(), when it is over.
  void addGap(const ContactArray& gap, const ros::Time& now) { bag_.write("/collision_monitor/contacts", now, gap); }

 private:
  void addLinks(const ros::Time& now);
  template <class Message>
  void writeLatched(const std::string& topic, const ros::Time& now, const Message& message);

  const MonitorLoop& loop_;
  MarkerDrawer drawer_;
  LinkMarkers link_markers_;
  BagWriter& bag_;
  std::map<std::string, geometry_msgs::TransformStamped> static_transforms_;     // by child frame
  std::map<std::string, boost::shared_ptr<ros::M_string>> latched_connections_;  // by topic
};

}  // namespace sdf_ccd
