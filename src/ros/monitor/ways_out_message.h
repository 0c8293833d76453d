#pragma once

#include "monitor/cycle_safety.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/WaysOut.h"

namespace sdf_ccd {

/// The pairs of the loop's last measurement that are within their stop distance, and the joints that move them apart.
WaysOut toWaysOut(const MonitorLoop& loop, const SafetyRules& rules);

}  // namespace sdf_ccd
