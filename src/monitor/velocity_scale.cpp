#include "monitor/velocity_scale.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {

double allowedClosing(const ClosingGap& gap, double age, const StoppingPromise& promise) {
  const double a = promise.deceleration, P = promise.period, T = age + promise.reaction_time;
  const double now = gap.closing + 0.5 * promise.max_acceleration * gap.over;
  // No gap closes faster than V; one that opens may start to close within T.
  const double fastest = std::clamp(now + promise.max_acceleration * T, 0.0, promise.max_speed);
  const double left = gap.width - promise.stop_distance - fastest * T;
  const double braking = fastest * fastest / (2.0 * a);
  if (left < fastest * P + braking) return std::max(0.0, (left - braking) / P);
  return 2.0 * left / (P + std::sqrt(P * P + 2.0 * left / a));  // solves u P + u²/2a = left without cancellation
}

double scaleRange(const StoppingPromise& promise) {
  const double V = promise.max_speed;
  return std::max(promise.stop_distance, promise.map_distance) +
         V * (promise.max_age + promise.reaction_time + promise.period) + V * V / (2.0 * promise.deceleration);
}

double velocityScale(const std::vector<PairDistance>& pairs, double age, double oldest,
                     const StoppingPromise& promise) {
  if (!(oldest <= promise.max_age)) return 0.0;
  StoppingPromise of_map = promise;
  of_map.stop_distance = std::max(promise.stop_distance, promise.map_distance);
  double allowed = promise.max_speed;
  for (const PairDistance& pair : pairs) {
    const double of_pair = std::max(0.0, age - pair.time);
    if (of_pair > promise.max_age) return 0.0;
    const StoppingPromise& kept = pair.is_with_map ? of_map : promise;
    double of_gap = allowedClosing(pair.any, of_pair, kept);
    if (pair.slab) of_gap = std::max(of_gap, allowedClosing(*pair.slab, of_pair, kept));
    if (!(of_gap >= 0.0)) return 0.0;  // NaN
    allowed = std::min(allowed, of_gap);
  }
  return allowed / promise.max_speed;
}

}  // namespace sdf_ccd
