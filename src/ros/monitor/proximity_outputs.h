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

/// Measures how near bodies are to each other, as far as somebody wants to know.
///
/// Publishes, below the node's name:
///   distances       sdf_ccd/DistanceArray  every cycle, if report_distance is set
///   velocity_scale  std_msgs/Float64       every cycle, and as 0 while there is none or one takes longer than
///                                          max_latency, if velocity_scale/max_speed is set
/// What has no subscriber, or no threshold, is not measured.
class ProximityOutputs {
 public:
  ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters);

  /// Thresholds and distances; whether there is a velocity scale stays as it is.
  void setParameters(const ProximityParameters& parameters);

  /// Whether anything will be measured in the next cycle: then it has to tell the clearances of all pairs.
  bool isWanted() const { return range() > 0.0; }

  /// Of the loop's last cycle: publishes the velocity scale at once, and sets the state's proximity.
  /// @return the distances, to be published; null if nobody listens.
  boost::shared_ptr<DistanceArray> measure(MonitorLoop& loop, MonitorState& state);

  void publishDistances(const boost::shared_ptr<DistanceArray>& distances) { distances_.publish(distances); }

  /// Nothing is checked: whoever obeys the scale stops.
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
