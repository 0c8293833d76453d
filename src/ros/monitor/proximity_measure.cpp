#include "ros/monitor/proximity_measure.h"

#include <algorithm>
#include <limits>

#include "ros/tf/seconds_between.h"

namespace sdf_ccd {

ProximityMeasure::ProximityMeasure(const ProximityParameters& parameters, MonitorLoop& loop)
    : loop_(loop),
      parameters_(parameters),
      promise_text_(parameters.promise ? promiseText(*parameters.promise) : std::string()) {}

void ProximityMeasure::setParameters(const ProximityParameters& parameters) {
  const std::optional<StoppingPromise> promise = parameters_.promise;
  parameters_ = parameters;
  if (!promise || !parameters.promise) parameters_.promise = promise;
}

SafetyRules ProximityMeasure::rules() const {
  constexpr double kBeyond = 1.01;  // what is as near as that is ignored
  SafetyRules rules{parameters_.thresholds, parameters_.promise, loop_.traits()};
  if (rules.promise)
    rules.promise->map_distance = kBeyond * std::max(rules.promise->map_distance, loop_.world()->mask_error);
  return rules;
}

double ProximityMeasure::range(bool lists_distances) const {
  return std::max(safetyRange(rules()), lists_distances ? parameters_.report_distance : 0.0);
}

const CycleSafety& ProximityMeasure::measure(bool lists_distances) {
  static const std::vector<PairDistance> none;
  if (const std::uint64_t version = loop_.world()->version(); version != version_) {
    version_ = version;
    memory_.scales.forgetPair();
  }
  const double wanted = range(lists_distances);
  if (!(wanted > 0.0)) loop_.forgetDistances();
  const std::vector<PairDistance>& near = wanted > 0.0 ? loop_.measureDistances(wanted) : none;
  const ros::Time now = ros::Time::now();  // measuring takes time, too
  const CycleFacts facts{loop_.result(),
                         near,
                         wanted > 0.0 && loop_.hasUnknownDistance(),
                         secondsBetween(loop_.cycle().origin, now),
                         secondsBetween(loop_.cycle().complete_until, now),
                         now.toSec()};
  return safety_ = judgeCycle(facts, rules(), memory_);
}

void ProximityMeasure::setState(const CycleSafety& safety, MonitorState& state) const {
  state.proximity = static_cast<std::uint8_t>(safety.proximity);
  state.velocity_scale = safety.velocity_scale.value_or(std::numeric_limits<double>::quiet_NaN());
  setLimit(safety, loop_.scene(), rules(), state.velocity_limit);
  state.velocity_promise = promise_text_;
}

}  // namespace sdf_ccd
