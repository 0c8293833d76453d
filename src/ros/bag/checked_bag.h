#pragma once

#include <map>
#include <string>

#include "ros/bag/bag_writer.h"
#include "ros/bag/recorded_motion.h"
#include "ros/messages/link_markers.h"
#include "ros/messages/markers.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/proximity_measure.h"

namespace sdf_ccd {

/// Writes the results of a check to a bag, with the transforms that were checked, so that rviz shows them as if live.
///
/// /tf, /tf_static  tf2_msgs/TFMessage  the transforms that were checked
/// Below /collision_monitor/, as the nodelet publishes it:
///   contacts         sdf_ccd/ContactArray            every cycle; when cycles stop; after each gap
///   state            sdf_ccd/MonitorState            the same
///   distances        sdf_ccd/DistanceArray           every cycle, if report_distance is set
///   velocity_scale   std_msgs/Float64                as state, if velocity_scale/max_speed is set
///   ways_out         sdf_ccd/WaysOut                 every cycle in which a pair is within its stop distance
///   wrenches/<link>  geometry_msgs/WrenchStamped     every cycle in which the link is in contact
///   markers          visualization_msgs/MarkerArray  contacts and status
///   links            visualization_msgs/MarkerArray  when a link's verdict changes
///   plan, world                                      once
class CheckedBag {
 public:
  /// @param bag    open and empty; the caller closes it. Its functions throw if it cannot be written.
  /// @param loop   its last cycle is measured and written by addCycle(). Loop and bag must outlive this.
  /// @param scene  description from which the loop's scene was built.
  CheckedBag(BagWriter& bag, MonitorLoop& loop, const SceneDescription& scene, const MonitorParameters& parameters);

  /// Writes the plan and the world, at the beginning of the bag.
  void addScene(const SceneDescription& description, const ros::Time& begin);

  void addTransforms(const RecordedTransforms& transforms);

  /// Writes the loop's last cycle.
  void addCycle(const ContactArray& contacts, const ros::Time& now);

  /// Writes that nothing is checked after the last cycle, and deletes the markers.
  void addUnchecked(const std::string& reason, const ros::Time& now);

  /// Writes the result of toGap(), at the end of the gap.
  void addGap(const ContactArray& gap, const ros::Time& now) { bag_.write("/collision_monitor/contacts", now, gap); }

 private:
  void addLinks(const ros::Time& now);
  template <class Message>
  void writeLatched(const std::string& topic, const ros::Time& now, const Message& message);

  void writeSafety(const CycleSafety& safety, MonitorState& state, const ros::Time& now);

  MonitorLoop& loop_;
  ProximityMeasure proximity_;
  bool lists_distances_;
  MarkerDrawer drawer_;
  LinkMarkers link_markers_;
  BagWriter& bag_;
  std::vector<std::string> warnings_;
  std::map<std::string, geometry_msgs::TransformStamped> static_transforms_;     // by child frame
  std::map<std::string, boost::shared_ptr<ros::M_string>> latched_connections_;  // by topic
};

}  // namespace sdf_ccd
