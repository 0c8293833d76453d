#pragma once

#include <functional>
#include <vector>

namespace sdf_ccd::benchmark {

/// Times of single cycles. Each is run several times, the runs of all systems in turn, and its median counts: so what
/// else the machine does meanwhile does not make the tail, but a cycle that is slow by itself does.
class CycleTimes {
 public:
  /// Runs cycle `i`; its time is what the call takes.
  using Cycle = std::function<void(std::size_t i)>;

  CycleTimes(std::size_t cycles, std::size_t stride) : stride_(stride), seconds_((cycles + stride - 1) / stride) {}

  /// One run over every stride-th cycle, from the first. @param prepare  is called before each and not timed.
  void run(const Cycle& prepare, const Cycle& cycle);

  /// The same for times that were taken elsewhere [s].
  void take(std::size_t cycle, double seconds) { seconds_[cycle / stride_].push_back(seconds); }

  /// Of the cycles' times, the one that so large a share of them does not exceed [s].
  double quantile(double share) const;

  std::size_t count() const { return seconds_.size(); }

 private:
  std::size_t stride_;
  std::vector<std::vector<double>> seconds_;  // per cycle, per run
};

}  // namespace sdf_ccd::benchmark
