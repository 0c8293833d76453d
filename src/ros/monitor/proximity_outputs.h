#pragma once

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
/// Without a subscriber or threshold, nothing is measured.
class ProximityOutputs {
 public:
  ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters);

  /// See ProximityMeasure::setParameters().
  void setParameters(const ProximityParameters& parameters) { measure_.setParameters(parameters); }

  /// Whether the next cycle will be measured: it must then report the clearances of all pairs.
  bool isWanted() const { return measure_.isNeeded(needs()); }

  /// Measures the loop's last cycle: publishes the velocity scale at once, and sets the state's proximity.
  /// @return the distances to publish; null if there is no subscriber.
  boost::shared_ptr<DistanceArray> measure(MonitorLoop& loop, MonitorState& state);

  void publishDistances(const boost::shared_ptr<DistanceArray>& distances) { distances_.publish(distances); }

  /// Reports that nothing is checked: a robot that obeys the scale stops.
  void publishUnchecked(MonitorState& state);

  /// The same while another thread measures.
  void publishStop(MonitorState& state) const;

 private:
  ProximityNeeds needs() const {
    const ProximityParameters& parameters = measure_.parameters();
    return {parameters.report_distance > 0.0 && distances_.getNumSubscribers() > 0,
            parameters.promise && velocity_scale_.getNumSubscribers() > 0};
  }
  void publishScale(double scale) const;

  ProximityMeasure measure_;
  ros::Publisher distances_, velocity_scale_;
  MessagePool<DistanceArray> messages_;
};

}  // namespace sdf_ccd
