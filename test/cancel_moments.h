#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "common/cancel_point.h"
#include "common/time_limit.h"
#include "oracle/busy_machine.h"

namespace sdf_ccd::test {

/// Seconds that work takes.
inline double secondsOf(const std::function<void()>& work) {
  const auto start = CancelRequest::Clock::now();
  work();
  return std::chrono::duration<double>(CancelRequest::Clock::now() - start).count();
}

/// Seconds until work ends that is cancelled after so many.
inline double secondsToEnd(const std::function<void()>& work, double cancelled_after) {
  using Clock = CancelRequest::Clock;
  std::atomic<bool> asked{false};
  Clock::time_point end;
  std::thread worker([&] {
    const CancelScope scope(asked);
    try {
      work();
    } catch (const Cancelled&) {
    }
    end = Clock::now();
  });
  std::this_thread::sleep_for(std::chrono::duration<double>(cancelled_after));
  const Clock::time_point start = Clock::now();
  asked = true;
  worker.join();
  return std::chrono::duration<double>(end - start).count();
}

/// Cancels work at moments all through it, or through its first seconds. Where that takes too long it is tried again,
/// as a virtual machine may stand still for as long; a stretch without a check takes too long every time.
/// @param soon  how long it may go on then [s]; no longer than half of it all, where that is quick.
inline void expectEndsSoon(const std::function<void()>& work, int moments, double soon) {
  constexpr int kTries = 4;
  constexpr double kLongest = 2.0;  // [s]
  const double whole = secondsOf([&] {
    try {
      withinSeconds(kLongest, "", work);
    } catch (const TookTooLong&) {
    }
  });
  const double limit = std::min(soon, 0.5 * whole) * slowness();
  double worst = 0.0, when = 0.0;
  for (int i = 0; i < moments; ++i) {
    const double after = whole * i / moments;
    double took = secondsToEnd(work, after);
    for (int again = 1; again < kTries && took >= limit; ++again) took = std::min(took, secondsToEnd(work, after));
    if (took > worst) when = after;
    worst = std::max(worst, took);
  }
  EXPECT_GT(whole, 0.03) << "what ends by itself shows nothing";
  EXPECT_LT(worst, limit) << "cancelled after " << when << " of " << whole << " s";
}

}  // namespace sdf_ccd::test
