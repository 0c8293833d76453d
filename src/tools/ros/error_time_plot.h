#pragma once

#include <string>
#include <vector>

#include "cycle_record.h"

namespace sdf_ccd::tools {

/// One line each.
struct PlotTitle {
  std::string title, subtitle;
};

/// Draws with gnuplot the error bound of each cycle over its run time, and both over time, coloured by verdict. Cycles
/// that checked no pair have no error bound; only their run times are drawn.
/// @param origin  from which times count.
/// @param svg     file to write.
/// @return false, and writes nothing, if gnuplot is missing or fails, or no cycle has a bound.
bool plotErrorTime(const std::vector<CycleRecord>& cycles, const ros::Time& origin, const PlotTitle& title,
                   const std::string& svg);

}  // namespace sdf_ccd::tools
