#pragma once

#include <cstdint>
#include <optional>

#include "monitor/proximity.h"
#include "ros/monitor/monitor_loop.h"

namespace sdf_ccd {

/// What is to be measured, besides the thresholds of the state's proximity.
struct ProximityNeeds {
  bool distances = false;
  bool velocity_scale = false;  ///< only if the parameters have a StoppingPromise
};

/// Measures the distances of bodies after each cycle, if they are needed, on the ROS clock.
class ProximityMeasure {
 public:
  explicit ProximityMeasure(const ProximityParameters& parameters) : parameters_(parameters) {}

  const ProximityParameters& parameters() const { return parameters_; }

  /// Sets thresholds and distances; whether there is a velocity scale does not change.
  void setParameters(const ProximityParameters& parameters);

  /// Whether something is measured: the cycle must then report the clearances of all pairs.
  bool isNeeded(const ProximityNeeds& needs) const { return range(needs) > 0.0; }

  struct Measured {
    std::uint8_t proximity = 0;            ///< MonitorState::proximity
    std::optional<double> velocity_scale;  ///< if it was needed
  };

  /// Measures the loop's last cycle; the distances are in the loop.
  Measured measure(const ProximityNeeds& needs, MonitorLoop& loop);

  /// The state's proximity while nothing is checked.
  std::uint8_t unchecked() { return static_cast<std::uint8_t>(watch_.update(0.0, parameters_.thresholds)); }

 private:
  /// Pairs farther apart than this need not be measured [m].
  double range(const ProximityNeeds& needs) const;

  ProximityParameters parameters_;
  ProximityWatch watch_;
};

}  // namespace sdf_ccd
