#include "ros/monitor/proximity_outputs.h"

#include <std_msgs/Float64.h>

#include "ros/monitor/cycle_messages.h"

namespace sdf_ccd {

ProximityOutputs::ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters)
    : measure_(parameters) {
  distances_ = private_node.advertise<DistanceArray>("distances", 100);
  if (parameters.promise) velocity_scale_ = private_node.advertise<std_msgs::Float64>("velocity_scale", 1);
}

boost::shared_ptr<DistanceArray> ProximityOutputs::measure(MonitorLoop& loop, MonitorState& state) {
  const ProximityNeeds needs = this->needs();
  const ProximityMeasure::Measured measured = measure_.measure(needs, loop);
  if (measured.velocity_scale) publishScale(*measured.velocity_scale);
  state.proximity = measured.proximity;
  if (!needs.distances) return nullptr;
  const boost::shared_ptr<DistanceArray> message = messages_.take();
  setDistanceArray(loop, measure_.parameters().report_distance, *message);
  return message;
}

void ProximityOutputs::publishUnchecked(MonitorState& state) {
  state.proximity = measure_.unchecked();
  if (needs().velocity_scale) publishScale(0.0);
}

void ProximityOutputs::publishStop(MonitorState& state) const {
  state.proximity = ProximityMeasure(measure_.parameters()).unchecked();
  if (needs().velocity_scale) publishScale(0.0);
}

void ProximityOutputs::publishScale(double scale) const {
  std_msgs::Float64 message;
  message.data = scale;
  velocity_scale_.publish(message);
}

}  // namespace sdf_ccd
