#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

#include "common/cancel_point.h"

namespace sdf_ccd {

/// The share done, reported by any thread. Stops if the thread that constructed it is cancelled.
class ProgressCounter {
 public:
  using Progress = std::function<void(double)>;

  ProgressCounter(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
  void add() {
    cancel_.check();
    const std::size_t done = ++done_;
    if (!progress_) return;
    std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (!lock && done == total_) lock.lock();  // the end is always reported
    if (lock && done > reported_) progress_(double(reported_ = done) / double(total_));
  }

 private:
  const CancelPoint cancel_;
  const Progress& progress_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::size_t reported_ = 0;
  std::mutex mutex_;
};

}  // namespace sdf_ccd
