#pragma once

#include "sdf_ccd/body/prepare_body.h"
#include "sdf_ccd/monitor/monitor.h"

namespace sdf_ccd {

/// Maximum deviation of a body's sampled motion from that between transforms [m]: the chords', but at most a fifth of
/// max_error.
double samplingTolerance(const MonitorOptions& options);

/// Sets the errors of motions that the bands of fields allow for.
/// @param sampling  of each body's sampled motion [m].
void setMotionErrors(double sampling, const ChordOptions& chords, BodyOptions& options);

/// The bodies' options of a monitor with default parameters.
BodyOptions defaultBodyOptions();

}  // namespace sdf_ccd
