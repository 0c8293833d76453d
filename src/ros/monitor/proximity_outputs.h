#pragma once

#include <cstdint>
#include <utility>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <boost/shared_ptr.hpp>

#include "ros/messages/message_pool.h"
#include "ros/monitor/proximity_measure.h"
#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Publishes what is measured of the distances of bodies, below the node's name:
///   distances       sdf_ccd/DistanceArray  every cycle, if report_distance is set
///   velocity_scale  std_msgs/Float64       every cycle, and 0 while none runs or one takes longer than max_latency, if
///                                          velocity_scale/max_speed is set
///   ways_out        sdf_ccd/WaysOut        every cycle: pairs within their stop distance, and the joints that part
///   them
/// Distances are measured if a threshold or velocity_scale/max_speed is set, or `distances` has a subscriber.
class ProximityOutputs {
 public:
  ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters, MonitorLoop& loop);

  /// See ProximityMeasure::setParameters().
  void setParameters(const ProximityParameters& parameters) { measure_.setParameters(parameters); }

  /// Whether the next cycle will be measured: it must then report the clearances of all pairs.
  bool isWanted() const { return measure_.isNeeded(listsDistances()); }

  /// Measures the loop's last cycle: publishes the velocity scale at once, and sets the state's part.
  /// @return the distances to publish; null if there is no subscriber.
  boost::shared_ptr<DistanceArray> measure(MonitorState& state);

  void publishDistances(const boost::shared_ptr<DistanceArray>& distances) { distances_.publish(distances); }

  /// Reports that nothing is checked: a robot that obeys the scale stops.
  void publishUnchecked(MonitorState& state);

  /// The same while another thread measures.
  void publishStop(MonitorState& state) const;

  /// Of the last cycle, or that there is none.
  const CycleSafety& safety() const { return measure_.safety(); }

 private:
  bool listsDistances() const {
    return measure_.parameters().report_distance > 0.0 && distances_.getNumSubscribers() > 0;
  }
  void publishScale(const CycleSafety& safety) const;
  void warnOfStandstill();

  MonitorLoop& loop_;
  ProximityMeasure measure_;
  ros::Publisher distances_, velocity_scale_, ways_out_;
  MessagePool<DistanceArray> messages_;
  std::pair<std::uint64_t, int> standing_{0, -1};  // scene version and pair of warnOfStandstill()'s warning
};

}  // namespace sdf_ccd
