#pragma once

#include <string>

#include "measurement.h"

/// Results of studies as text.
namespace sdf_ccd::precision {

/// A header line, and a line per row: study, quantity, error_unit, system, setting, value, seconds_per_query,
/// error_median, error_p99, error_max, bound, missed, queries. Unknown values are empty.
std::string csvText(const StudyResult& result);

/// A table for display: a block of aligned columns per quantity.
std::string tableText(const StudyResult& result);

/// A script for gnuplot that draws a panel per quantity into an SVG file: time per query on x, error on y, both
/// logarithmic; for each system its medians joined by a line, a cross at the 99th percentile, and a bar up to the
/// maximum.
std::string plotScript(const StudyResult& result, const std::string& svg_path);

}  // namespace sdf_ccd::precision
