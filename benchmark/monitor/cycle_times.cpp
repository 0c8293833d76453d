#include "monitor/cycle_times.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sdf_ccd::benchmark {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

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
  for (const std::vector<double>& runs : seconds_) medians.push_back(median(runs));
  std::sort(medians.begin(), medians.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(medians.size())));
  return medians[std::min(std::max<std::size_t>(rank, 1), medians.size()) - 1];
}

}  // namespace sdf_ccd::benchmark
