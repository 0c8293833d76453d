#pragma once

#include <functional>
#include <vector>

namespace sdf_ccd::benchmark {

/// Times of single cycles. Each cycle is run several times, the runs of all systems in turn, and the median of its
/// times is used, so that the tail shows cycles that are slow themselves and not other load of the computer.
class CycleTimes {
 public:
  /// Runs cycle `i`; the duration of the call is its time.
  using Cycle = std::function<void(std::size_t i)>;

  CycleTimes(std::size_t cycles, std::size_t stride) : stride_(stride), seconds_((cycles + stride - 1) / stride) {}

  /// Runs every stride-th cycle once, beginning with the first. @param prepare  called before each cycle; not timed.
  void run(const Cycle& prepare, const Cycle& cycle);

  /// Adds a time that was measured elsewhere [s].
  void take(std::size_t cycle, double seconds) { seconds_[cycle / stride_].push_back(seconds); }

  /// Quantile of the cycles' median times [s].
  double quantile(double share) const;

  std::size_t count() const { return seconds_.size(); }

 private:
  std::size_t stride_;
  std::vector<std::vector<double>> seconds_;  // per cycle, per run
};

}  // namespace sdf_ccd::benchmark
