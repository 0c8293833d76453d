#include "ros/monitor/reconfiguration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>

#include <fmt/format.h>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

CollisionMonitorConfig configOf(const MonitorParameters& parameters) {
  CollisionMonitorConfig config = CollisionMonitorConfig::__getDefault__();
  config.rate = parameters.rate;
  config.max_cycle_time = parameters.max_cycle_time;
  config.report_distance = parameters.proximity.report_distance;
  config.warning_distance = parameters.proximity.thresholds.warning;
  config.stop_distance = parameters.proximity.thresholds.stop;
  config.hysteresis = parameters.proximity.thresholds.hysteresis;
  config.max_points = parameters.max_points;
  config.marker_scale = parameters.markers.scale;
  config.marker_hold = parameters.markers.hold;
  return config;
}

VelocityScaleConfig configOf(const StoppingPromise& promise) {
  VelocityScaleConfig config = VelocityScaleConfig::__getDefault__();
  config.max_speed = promise.max_speed;
  config.max_acceleration = promise.max_acceleration;
  config.deceleration = promise.deceleration;
  config.reaction_time = promise.reaction_time;
  config.period = promise.period;
  config.max_age = promise.max_age;
  return config;
}

void apply(const CollisionMonitorConfig& config, MonitorParameters& parameters) {
  parameters.rate = config.rate;
  parameters.trigger.period = 1.0 / config.rate;
  parameters.max_cycle_time = config.max_cycle_time;
  parameters.proximity.report_distance = config.report_distance;
  parameters.proximity.thresholds = {config.warning_distance, config.stop_distance, config.hysteresis};
  if (parameters.proximity.promise) parameters.proximity.promise->stop_distance = config.stop_distance;
  parameters.max_points = config.max_points;
  parameters.markers.scale = config.marker_scale;
  parameters.markers.hold = config.marker_hold;
}

void apply(const VelocityScaleConfig& config, StoppingPromise& promise) {
  promise.max_speed = config.max_speed;
  promise.max_acceleration = config.max_acceleration;
  promise.deceleration = config.deceleration;
  promise.reaction_time = config.reaction_time;
  promise.period = config.period;
  promise.max_age = config.max_age;
}

/// NaN passes the limits of dynamic_reconfigure.
template <class Config>
std::string notFinite(const Config& config) {
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  const auto bad = std::find_if(message.doubles.begin(), message.doubles.end(),
                                [](const auto& number) { return !std::isfinite(number.value); });
  return bad == message.doubles.end() ? "" : bad->name + " is not finite";
}

/// One side of a start-up value.
struct Limit {
  const char* name;
  double value, start;
  enum { kNotLess, kNotMore, kEqual } side;

  bool holds() const {
    return value == start || (side == kNotLess && value > start) || (side == kNotMore && value < start);
  }
};

std::string whyBeyond(std::initializer_list<Limit> limits) {
  const auto beyond = std::find_if(limits.begin(), limits.end(), [](const Limit& limit) { return !limit.holds(); });
  if (beyond == limits.end()) return {};
  constexpr std::array<const char*, 3> kSides{"at least", "at most", "equal to"};
  return fmt::format("{} must stay {} its start-up value {}, as the parameter requests/allow does not hold limits",
                     beyond->name, kSides[beyond->side], numberText(beyond->start));
}

std::string whyBeyond(const CollisionMonitorConfig& config, const CollisionMonitorConfig& start) {
  return whyBeyond({{"rate", config.rate, start.rate, Limit::kNotLess},
                    {"max_cycle_time", config.max_cycle_time, start.max_cycle_time, Limit::kEqual},
                    {"report_distance", config.report_distance, start.report_distance, Limit::kNotLess},
                    {"warning_distance", config.warning_distance, start.warning_distance, Limit::kNotLess},
                    {"stop_distance", config.stop_distance, start.stop_distance, Limit::kNotLess},
                    {"hysteresis", config.hysteresis, start.hysteresis, Limit::kNotLess}});
}

std::string whyBeyond(const VelocityScaleConfig& config, const VelocityScaleConfig& start) {
  return whyBeyond({{"max_speed", config.max_speed, start.max_speed, Limit::kNotLess},
                    {"max_acceleration", config.max_acceleration, start.max_acceleration, Limit::kNotLess},
                    {"deceleration", config.deceleration, start.deceleration, Limit::kNotMore},
                    {"reaction_time", config.reaction_time, start.reaction_time, Limit::kNotLess},
                    {"period", config.period, start.period, Limit::kNotLess},
                    {"max_age", config.max_age, start.max_age, Limit::kNotMore}});
}

std::string whyInvalid(const CollisionMonitorConfig& config) {
  if (config.warning_distance > 0.0 && config.warning_distance < config.stop_distance) {
    return "warning_distance must be 0 or at least stop_distance";
  }
  const std::string no_time = whyNoCycleTime(config.max_cycle_time);
  if (!no_time.empty()) return "max_cycle_time: expected " + no_time;
  return notFinite(config);
}

std::string whyInvalid(const VelocityScaleConfig& config) {
  return notFinite(config);
}

/// Refuses what is invalid and, unless it is allowed, what leaves the safe side of the start-up values.
template <class Config>
std::function<std::string(const Config&)> refusalOf(const Config& start, bool are_limits_allowed) {
  return [start, are_limits_allowed](const Config& config) {
    const std::string why = whyInvalid(config);
    return !why.empty() || are_limits_allowed ? why : whyBeyond(config, start);
  };
}

}  // namespace

template <class Config>
ConfigServer<Config>::ConfigServer(const ros::NodeHandle& node, const Config& start,
                                   std::function<std::string(const Config&)> why_invalid, std::function<void()> changed)
    : current_(start), why_invalid_(std::move(why_invalid)), changed_(std::move(changed)), server_(node) {
  server_.setCallback([this](Config& config, std::uint32_t) { set(config); });
}

template <class Config>
void ConfigServer<Config>::set(Config& config) {
  const bool is_first = std::exchange(is_first_call_, false);  // the server's own, clamped to its limits
  const std::string why_not = is_first ? "" : why_invalid_(config);
  if (!why_not.empty()) ROS_WARN("dynamic_reconfigure: the new values are rejected: %s", why_not.c_str());
  {
    const std::lock_guard<std::mutex> lock(mutex_);  // the cycles wait for it: not while the console may block
    if (is_first || !why_not.empty()) {
      config = current_;
      return;
    }
    current_ = config;
    has_changed_ = true;
  }
  changed_();
}

template <class Config>
std::optional<Config> ConfigServer<Config>::changes() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!has_changed_) return std::nullopt;
  has_changed_ = false;
  return current_;
}

Reconfiguration::Reconfiguration(const ros::NodeHandle& private_node, const MonitorParameters& parameters,
                                 const std::function<void()>& changed)
    : monitor_(private_node, configOf(parameters), refusalOf(configOf(parameters), parameters.requests.limits),
               changed) {
  if (!parameters.proximity.promise) return;
  const VelocityScaleConfig start = configOf(*parameters.proximity.promise);
  velocity_scale_ = std::make_unique<ConfigServer<VelocityScaleConfig>>(
      ros::NodeHandle(private_node, "velocity_scale"), start, refusalOf(start, parameters.requests.limits), changed);
}

bool Reconfiguration::apply(MonitorParameters& parameters) {
  const std::optional<CollisionMonitorConfig> monitor = monitor_.changes();
  if (monitor) sdf_ccd::apply(*monitor, parameters);
  const std::optional<VelocityScaleConfig> scale = velocity_scale_ ? velocity_scale_->changes() : std::nullopt;
  if (scale) sdf_ccd::apply(*scale, *parameters.proximity.promise);
  return monitor || scale;
}

}  // namespace sdf_ccd
