#include "error_summary.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sdf_ccd::precision {

double quantile(std::vector<double>& values, double q) {
  if (values.empty()) throw std::invalid_argument("a quantile of no values");
  const double rank = std::ceil(q * double(values.size()));
  const auto at = values.begin() + std::ptrdiff_t(std::clamp(rank - 1.0, 0.0, double(values.size() - 1)));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

ErrorSummary summarize(std::vector<double> errors) {
  return {quantile(errors, 0.5), quantile(errors, 0.99), quantile(errors, 1.0), errors.size()};
}

}  // namespace sdf_ccd::precision
