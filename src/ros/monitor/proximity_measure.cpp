#include "ros/monitor/proximity_measure.h"

#include <algorithm>

#include "common/infinity.h"
#include "monitor/velocity_scale.h"
#include "ros/tf/seconds_between.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

void ProximityMeasure::setParameters(const ProximityParameters& parameters) {
  const std::optional<StoppingPromise> promise = parameters_.promise;
  parameters_ = parameters;
  if (!promise || !parameters.promise) parameters_.promise = promise;
}

double ProximityMeasure::range(const ProximityNeeds& needs) const {
  double range = parameters_.thresholds.range();
  if (needs.distances) range = std::max(range, parameters_.report_distance);
  if (needs.velocity_scale && parameters_.promise) range = std::max(range, scaleRange(*parameters_.promise));
  return range;
}

ProximityMeasure::Measured ProximityMeasure::measure(const ProximityNeeds& needs, MonitorLoop& loop) {
  Measured measured;
  std::optional<StoppingPromise> promise;
  if (needs.velocity_scale && parameters_.promise) {
    constexpr double kBeyond = 1.01;  // what is as near as that is ignored
    promise = parameters_.promise;
    promise->map_distance = kBeyond * std::max(promise->map_distance, loop.world()->mask_error);
  }
  const double wanted = std::max(range(needs), promise ? scaleRange(*promise) : 0.0);
  measured.proximity = MonitorState::NOT_WATCHED;
  if (!(wanted > 0.0)) {
    loop.forgetDistances();
    return measured;
  }
  const std::vector<PairDistance>& near = loop.measureDistances(wanted);
  const CycleResult& result = loop.result();
  const bool is_known = result.not_checked == 0 && result.verdict != Verdict::kUncertain && !loop.hasUnknownDistance();
  const bool is_safe = is_known && result.verdict != Verdict::kContact;
  if (promise) {
    const ros::Time now = ros::Time::now();  // measuring takes time, too
    const double age = secondsBetween(loop.cycle().origin, now),
                 oldest = secondsBetween(loop.cycle().complete_until, now);
    measured.velocity_scale = is_safe ? velocityScale(near, age, oldest, *promise) : 0.0;
  }
  double nearest = is_safe ? kInfinity : 0.0;
  for (const PairDistance& pair : near) nearest = std::min(nearest, pair.any.width);
  measured.proximity = static_cast<std::uint8_t>(watch_.update(nearest, parameters_.thresholds));
  return measured;
}

}  // namespace sdf_ccd
