#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// The time that each pair of a scene has taken. Threads may add at once.
class PairTimes {
 public:
  explicit PairTimes(std::size_t pairs) : nanoseconds_(pairs) {}

  /// Adds its own lifetime to a pair's time.
  class Measure {
   public:
    Measure(PairTimes* times, int pair) : times_(times), pair_(pair) {
      if (times_) start_ = Clock::now();
    }
    ~Measure() {
      if (!times_) return;
      const auto spent = std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start_);
      times_->nanoseconds_[static_cast<std::size_t>(pair_)] += spent.count();
    }
    Measure(const Measure&) = delete;
    Measure& operator=(const Measure&) = delete;

   private:
    using Clock = std::chrono::steady_clock;
    PairTimes* times_;
    int pair_;
    Clock::time_point start_;
  };

  /// The pairs that have taken most of the time, with their shares: "a - b (71 %), c - d (12 %)". Empty if no time was
  /// measured.
  std::string longest(const Scene& scene) const;

 private:
  std::vector<std::atomic<std::int64_t>> nanoseconds_;
};

}  // namespace sdf_ccd
