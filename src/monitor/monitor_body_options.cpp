#include "monitor_body_options.h"

#include <algorithm>

namespace sdf_ccd {

double samplingTolerance(const MonitorOptions& options) {
  constexpr double kOfMotion = 0.2;  // fraction of max_error for each body's motion
  return std::min(options.chords.tolerance, kOfMotion * options.max_error);
}

void setMotionErrors(double sampling, const ChordOptions& chords, BodyOptions& options) {
  options.motion_error = 2.0 * sampling;
  options.motion_margin = options.motion_error + chords.tolerance;
}

BodyOptions defaultBodyOptions() {
  const MonitorOptions monitor;
  BodyOptions options = optionsForContacts();
  setMotionErrors(samplingTolerance(monitor), monitor.chords, options);
  return options;
}

}  // namespace sdf_ccd
