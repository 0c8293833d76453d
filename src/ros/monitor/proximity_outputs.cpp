#include "ros/monitor/proximity_outputs.h"

#include <ros/console.h>
#include <std_msgs/Float64.h>

#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/ways_out_message.h"
#include "scene/name_pair.h"

namespace sdf_ccd {

ProximityOutputs::ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters,
                                   MonitorLoop& loop)
    : loop_(loop), measure_(parameters, loop) {
  distances_ = private_node.advertise<DistanceArray>("distances", 100);
  ways_out_ = private_node.advertise<WaysOut>("ways_out", 10);
  if (!parameters.promise) return;
  velocity_scale_ = private_node.advertise<std_msgs::Float64>("velocity_scale", 1);
  ROS_INFO("%s. %s.", rangeText(measure_.rules()).c_str(), promiseText(*parameters.promise).c_str());
}

boost::shared_ptr<DistanceArray> ProximityOutputs::measure(MonitorState& state) {
  const bool lists_distances = listsDistances();
  const CycleSafety& safety = measure_.measure(lists_distances);
  publishScale(safety);
  measure_.setState(safety, state);
  warnOfStandstill();
  if (ways_out_.getNumSubscribers() > 0) ways_out_.publish(toWaysOut(loop_, measure_.rules()));
  if (!lists_distances) return nullptr;
  const boost::shared_ptr<DistanceArray> message = messages_.acquire();
  setDistanceArray(loop_, measure_.parameters().report_distance, *message);
  return message;
}

void ProximityOutputs::publishUnchecked(MonitorState& state) {
  const CycleSafety& safety = measure_.noCycle();
  publishScale(safety);
  measure_.setState(safety, state);
}

void ProximityOutputs::publishStop(MonitorState& state) const {
  const CycleSafety safety = measure_.noCycleMeanwhile();
  publishScale(safety);
  measure_.setState(safety, state);
}

void ProximityOutputs::publishScale(const CycleSafety& safety) const {
  if (!safety.velocity_scale || velocity_scale_.getNumSubscribers() == 0) return;
  std_msgs::Float64 message;
  message.data = *safety.velocity_scale;
  velocity_scale_.publish(message);
}

/// With own_pairs: promise, two links that are near each other for good stop the robot for good.
void ProximityOutputs::warnOfStandstill() {
  const CycleSafety& safety = measure_.safety();
  const bool stands = safety.limiting && safety.velocity_scale == 0.0 && loop_.traits()[safety.limiting->pair].is_own &&
                      measure_.parameters().promise->own_pairs == OwnPairs::kPromise;
  const std::pair<std::uint64_t, int> standing =
      stands ? std::pair(loop_.world()->version(), safety.limiting->pair) : std::pair(std::uint64_t{0}, -1);
  if (standing == standing_) return;
  standing_ = standing;
  std::string text;
  if (stands)
    text = "velocity_scale is 0: " + pairName(loop_.scene(), *safety.limiting) +
           " are closer than velocity_scale/own_pairs: promise lets two links come";
  loop_.warnings().set("own_pairs", text);
}

}  // namespace sdf_ccd
