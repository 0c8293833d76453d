#include "ros/monitor/cycle_watchdog.h"

#include <gtest/gtest.h>

#include <thread>

namespace sdf_ccd::cycle_watchdog_test {

using Seconds = CycleWatchdog::Seconds;
using Clock = std::chrono::steady_clock;

TEST(CycleWatchdog, ReportsACycleThatDoesNotEndAgainAndAgain) {
  constexpr int kReports = 3;
  const Seconds limit(0.02);
  std::atomic<int> reports{0};
  std::atomic<double> last{0.0};
  CycleWatchdog watchdog(limit, [&](Seconds elapsed) {
    last = elapsed.count();
    ++reports;
  });
  const auto start = Clock::now();
  {
    const CycleWatchdog::Cycle cycle(watchdog);
    while (reports < kReports && Clock::now() - start < std::chrono::seconds(60)) std::this_thread::yield();
  }
  EXPECT_GE(reports, kReports);
  EXPECT_GE(last, kReports * limit.count());
  EXPECT_LE(last, Seconds(Clock::now() - start).count());
  const int told = reports;
  std::this_thread::sleep_for(5 * limit);
  EXPECT_EQ(reports, told) << "of a cycle that has ended";
}

TEST(CycleWatchdog, ShortCyclesAreNotReportedHoweverManyThereAre) {
  std::atomic<int> reports{0};
  CycleWatchdog watchdog(Seconds(60.0), [&](Seconds) { ++reports; });
  for (int i = 0; i < 10000; ++i) const CycleWatchdog::Cycle cycle(watchdog);
  EXPECT_EQ(reports, 0);
}

TEST(CycleWatchdog, EndsAtOnceEvenWithinACycle) {
  const auto start = Clock::now();
  {
    CycleWatchdog watchdog(Seconds(1e3), [](Seconds) {});
    const CycleWatchdog::Cycle cycle(watchdog);
  }
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
}

}  // namespace sdf_ccd::cycle_watchdog_test
