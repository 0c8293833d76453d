#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <boost/shared_ptr.hpp>

#include "monitor/proximity.h"
#include "ros/messages/message_pool.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Measures the distances of bodies, if they are needed.
///
/// Publishes, below the node's name:
///   distances       sdf_ccd/DistanceArray  every cycle, if report_distance is set
///   velocity_scale  std_msgs/Float64       every cycle, and 0 while none runs or one takes longer than max_latency, if
///                                          velocity_scale/max_speed is set
/// Without a subscriber or threshold, nothing is measured.
class ProximityOutputs {
 public:
  ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters);

  /// Sets thresholds and distances; whether a velocity scale is published does not change.
  void setParameters(const ProximityParameters& parameters);

  /// Whether the next cycle will be measured: it must then report the clearances of all pairs.
  bool isWanted() const { return range() > 0.0; }

  /// Measures the loop's last cycle: publishes the velocity scale at once, and sets the state's proximity.
  /// @return the distances to publish; null if there is no subscriber.
  boost::shared_ptr<DistanceArray> measure(MonitorLoop& loop, MonitorState& state);

  void publishDistances(const boost::shared_ptr<DistanceArray>& distances) { distances_.publish(distances); }

  /// Reports that nothing is checked: a robot that obeys the scale stops.
  void publishUnchecked(MonitorState& state);

  /// The same while another thread measures.
  void publishStop(MonitorState& state) const;

 private:
  double range() const;
  bool listsDistances() const { return parameters_.report_distance > 0.0 && distances_.getNumSubscribers() > 0; }
  bool scalesVelocity() const { return parameters_.promise && velocity_scale_.getNumSubscribers() > 0; }
  void publishScale(double scale) const;

  ProximityParameters parameters_;
  ros::Publisher distances_, velocity_scale_;
  ProximityWatch watch_;
  MessagePool<DistanceArray> messages_;
};

}  // namespace sdf_ccd
