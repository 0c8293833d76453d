#pragma once

#include <cstddef>
#include <vector>

namespace sdf_ccd::precision {

/// Errors of many queries in three numbers.
struct ErrorSummary {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
  std::size_t count = 0;
};

/// The smallest value that at least the share q of all values does not exceed; q in [0, 1]. Reorders the values.
/// @throws std::invalid_argument if there are none.
double quantile(std::vector<double>& values, double q);

/// @throws std::invalid_argument if there are no errors.
ErrorSummary summarize(std::vector<double> errors);

}  // namespace sdf_ccd::precision
