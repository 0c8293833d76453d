#include "ros/monitor/proximity_outputs.h"

#include <algorithm>
#include <limits>

#include <std_msgs/Float64.h>

#include "monitor/velocity_scale.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {

ProximityOutputs::ProximityOutputs(ros::NodeHandle private_node, const ProximityParameters& parameters)
    : parameters_(parameters) {
  distances_ = private_node.advertise<DistanceArray>("distances", 100);
  if (parameters.promise) velocity_scale_ = private_node.advertise<std_msgs::Float64>("velocity_scale", 1);
}

void ProximityOutputs::setParameters(const ProximityParameters& parameters) {
  const std::optional<StoppingPromise> promise = parameters_.promise;
  parameters_ = parameters;
  if (!promise || !parameters.promise) parameters_.promise = promise;
}

double ProximityOutputs::range() const {
  double range = parameters_.thresholds.range();
  if (listsDistances()) range = std::max(range, parameters_.report_distance);
  if (scalesVelocity()) range = std::max(range, scaleRange(*parameters_.promise));
  return range;
}

boost::shared_ptr<DistanceArray> ProximityOutputs::measure(MonitorLoop& loop, MonitorState& state) {
  std::optional<StoppingPromise> promise;
  if (scalesVelocity()) {
    constexpr double kBeyond = 1.01;  // what is as near as that is ignored
    promise = parameters_.promise;
    promise->map_distance = kBeyond * std::max(promise->map_distance, loop.world()->mask_error);
  }
  const double wanted = std::max(range(), promise ? scaleRange(*promise) : 0.0);
  state.proximity = MonitorState::NOT_WATCHED;
  if (!(wanted > 0.0)) {
    loop.forgetDistances();
    return nullptr;
  }
  const std::vector<PairDistance>& near = loop.measureDistances(wanted);
  const CycleResult& result = loop.result();
  const bool is_known = result.not_checked == 0 && result.verdict != Verdict::kUncertain && !loop.hasUnknownDistance();
  if (promise) {
    const ros::Time now = ros::Time::now();  // measuring takes time, too
    const double age = secondsBetween(loop.cycle().origin, now),
                 oldest = secondsBetween(loop.cycle().complete_until, now);
    const bool is_safe = is_known && result.verdict != Verdict::kContact;
    publishScale(is_safe ? velocityScale(near, age, oldest, *promise) : 0.0);
  }
  double nearest = is_known && result.verdict != Verdict::kContact ? std::numeric_limits<double>::infinity() : 0.0;
  for (const PairDistance& pair : near) nearest = std::min(nearest, pair.any.width);
  state.proximity = static_cast<std::uint8_t>(watch_.update(nearest, parameters_.thresholds));
  if (!listsDistances()) return nullptr;
  const boost::shared_ptr<DistanceArray> message = messages_.take();
  setDistanceArray(loop, parameters_.report_distance, *message);
  return message;
}

void ProximityOutputs::publishUnchecked(MonitorState& state) {
  state.proximity = static_cast<std::uint8_t>(watch_.update(0.0, parameters_.thresholds));
  if (scalesVelocity()) publishScale(0.0);
}

void ProximityOutputs::publishStop(MonitorState& state) const {
  state.proximity = static_cast<std::uint8_t>(ProximityWatch().update(0.0, parameters_.thresholds));
  if (scalesVelocity()) publishScale(0.0);
}

void ProximityOutputs::publishScale(double scale) const {
  std_msgs::Float64 message;
  message.data = scale;
  velocity_scale_.publish(message);
}

}  // namespace sdf_ccd
