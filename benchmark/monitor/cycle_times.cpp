#include "monitor/cycle_times.h"

#include <chrono>

#include "precision/error_summary.h"

namespace sdf_ccd::benchmark {
void CycleTimes::run(const Cycle& prepare, const Cycle& cycle) {
  using Clock = std::chrono::steady_clock;
  for (std::size_t k = 0; k < seconds_.size(); ++k) {
    const std::size_t i = k * stride_;
    prepare(i);
    const auto start = Clock::now();
    cycle(i);
    seconds_[k].push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
}

double CycleTimes::quantile(double share) const {
  std::vector<double> medians;
  for (std::vector<double> runs : seconds_) medians.push_back(precision::quantile(runs, 0.5));
  return precision::quantile(medians, share);
}

}  // namespace sdf_ccd::benchmark
