#include <algorithm>
#include <cmath>

#include "monitor/pair_traits.h"
#include "sdf_ccd/distances.h"

namespace sdf_ccd {
namespace {

/// Solves u `time` + u²/2a = width, without cancellation.
double stoppableSpeed(double width, double time, double deceleration) {
  return 2.0 * width / (time + std::sqrt(time * time + 2.0 * width / deceleration));
}

/// The scale that allowedClosing() gives the pair.
double promisedScale(const PairDistance& pair, double age, const StoppingPromise& promise) {
  double allowed = allowedClosing(pair.any, age, promise);
  if (pair.slab) allowed = std::max(allowed, allowedClosing(*pair.slab, age, promise));
  return allowed / promise.max_speed;
}

/// The speed at which the distance decreases [m/s].
double closingOf(const PairDistance& pair) {
  return pair.normal_W.isZero() ? pair.any.closing : pair.closing_speed;
}

/// Time from a scale to when its effect is measured, at most [s].
double lateness(const StoppingPromise& promise) {
  return promise.max_age + promise.reaction_time + promise.period;
}

/// Whether a scale published then may be the cause of what is measured now. Not if the clock was set back.
bool isRecent(double then, double now, const StoppingPromise& promise) {
  return now - lateness(promise) <= then && then <= now;
}

}  // namespace

double allowedClosing(const ClosingGap& gap, double age, const StoppingPromise& promise) {
  const double a = promise.deceleration, P = promise.period, T = age + promise.reaction_time;
  const double now = gap.closing + 0.5 * promise.max_acceleration * gap.over;
  // No gap closes faster than V; one that opens may start to close within T.
  const double fastest = std::clamp(now + promise.max_acceleration * T, 0.0, promise.max_speed);
  const double left = gap.width - promise.stop_distance - fastest * T;
  const double braking = fastest * fastest / (2.0 * a);
  if (left < fastest * P + braking) return std::max(0.0, (left - braking) / P);
  return stoppableSpeed(left, P, a);
}

double measuredScale(double width, double closing, double scale, double age, const StoppingPromise& promise) {
  const double left = width - promise.stop_distance;
  if (!(left > 0.0)) return 0.0;
  if (closing <= 0.0) return 1.0;
  const double at_scale_one = std::min(promise.max_speed, closing / std::max(scale, 0.0));
  const double stoppable = stoppableSpeed(left, age + promise.reaction_time + promise.period, promise.deceleration);
  return std::min(1.0, 2.0 / 3.0 * stoppable / at_scale_one);
}

double scaleRange(const StoppingPromise& promise, double stop_distance) {
  const double V = promise.max_speed;
  return std::max(stop_distance, promise.map_distance) + V * lateness(promise) + V * V / (2.0 * promise.deceleration);
}

double standstillDistance(const StoppingPromise& promise, double stop_distance, double max_speed) {
  const double R = promise.reaction_time, fastest = std::min(max_speed, promise.max_acceleration * R);
  return stop_distance + fastest * R + fastest * fastest / (2.0 * promise.deceleration);
}

ScaleLimits velocityScales(const std::vector<PairDistance>& pairs, const std::vector<PairTraits>& traits, double age,
                           double oldest, double obeyed, const StoppingPromise& promise) {
  if (!(oldest <= promise.max_age)) return {};
  double promised = 1.0, measured = 1.0;
  const PairDistance *of_promised = nullptr, *of_measured = nullptr;
  for (const PairDistance& pair : pairs) {
    const PairTraits& of_pair = traitsOf(pair, traits);
    const double age_of_pair = std::max(age - pair.time, 0.0);  // NaN stays NaN
    const bool is_old = !(age_of_pair <= promise.max_age);
    if (!is_old && cannotChange(pair, of_pair)) continue;
    StoppingPromise kept = promise;
    kept.stop_distance = of_pair.stop_distance.value_or(promise.stop_distance);
    if (pair.is_with_map) kept.stop_distance = std::max(kept.stop_distance, promise.map_distance);
    const bool is_measured = of_pair.is_own && promise.own_pairs == OwnPairs::kMeasured;
    if (of_pair.is_own) kept.max_speed = std::min(kept.max_speed, of_pair.max_closing);
    const double scale = is_old        ? 0.0
                         : is_measured ? measuredScale(pair.any.width, closingOf(pair), obeyed, age_of_pair, kept)
                                       : promisedScale(pair, age_of_pair, kept);
    double& least = is_measured ? measured : promised;
    if (scale >= least) continue;  // not if it is NaN
    least = scale >= 0.0 ? scale : 0.0;
    (is_measured ? of_measured : of_promised) = &pair;
  }
  const auto limit = [](double scale, const PairDistance* pair) {
    return ScaleLimit{scale, pair ? std::optional<PairDistance>(*pair) : std::nullopt};
  };
  return {limit(promised, of_promised), limit(measured, of_measured)};
}

double PublishedScales::obeyed(double time, const StoppingPromise& promise) const {
  double smallest = 1.0;
  for (const Published& published : published_)
    if (isRecent(published.time, time, promise)) smallest = std::min(smallest, published.scale);
  return smallest;
}

ScaleLimit PublishedScales::limitRise(const ScaleLimit& measured, double time, const StoppingPromise& promise) {
  constexpr double kBegin = 1e-4;  // a scale of 0 rises from here
  const double elapsed = std::max(0.0, time - time_);
  time_ = time;
  measured_.scale = std::min(1.0, std::max(kBegin, measured_.scale) * std::exp(elapsed / (2.0 * lateness(promise))));
  if (measured_.scale >= 1.0) measured_.pair.reset();
  if (measured.scale < measured_.scale) measured_ = measured;
  return measured_;
}

void PublishedScales::add(double scale, double time, const StoppingPromise& promise) {
  const auto isPast = [&](const Published& published) { return !isRecent(published.time, time, promise); };
  published_.erase(std::remove_if(published_.begin(), published_.end(), isPast), published_.end());
  published_.push_back({time, scale});
}

}  // namespace sdf_ccd
