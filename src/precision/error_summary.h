#pragma once

#include <cstddef>
#include <vector>

namespace sdf_ccd::precision {

/// Median, 99th percentile and maximum of the errors of many queries.
struct ErrorSummary {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
  std::size_t count = 0;
};

/// The q-quantile, q in [0, 1]: the smallest value such that at least the fraction q of all values is not above it.
/// Reorders the values. @throws std::invalid_argument if there are none.
double quantile(std::vector<double>& values, double q);

/// @throws std::invalid_argument if there are no errors.
ErrorSummary summarize(std::vector<double> errors);

}  // namespace sdf_ccd::precision
