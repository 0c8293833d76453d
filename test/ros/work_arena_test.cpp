#include "ros/monitor/work_arena.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <map>
#include <stdexcept>

#include <tbb/global_control.h>

#include "common/cancel_point.h"
#include "common/parallel_for.h"
#include "ros/monitor/low_priority.h"

namespace sdf_ccd::work_arena_test {

constexpr int kThreads = 3;
constexpr auto kPatience = std::chrono::seconds(20);

/// Runs a parallel loop on this many threads. @return the niceness of each.
std::map<std::thread::id, int> nicenessOfLoop(std::size_t threads) {
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::thread::id, int> niceness;
  tbb::parallel_for(
      tbb::blocked_range<int>(0, 100),
      [&](const tbb::blocked_range<int>&) {
        std::unique_lock<std::mutex> lock(mutex);
        niceness.emplace(std::this_thread::get_id(), getpriority(PRIO_PROCESS, 0));  // on Linux: of this thread
        changed.notify_all();
        changed.wait_for(lock, kPatience, [&] { return niceness.size() >= threads; });
      },
      tbb::simple_partitioner());
  return niceness;
}

void expectAll(int expected, const std::map<std::thread::id, int>& niceness) {
  EXPECT_EQ(niceness.size(), std::size_t(kThreads));
  for (const auto& [thread, nice] : niceness) EXPECT_EQ(nice, expected) << thread;
}

/// As a query or a build does.
void expectLowInArena() {
  WorkArena arena(kThreads);
  std::thread([&] {
    lowerPriority();
    for (int i = 0; i < 3; ++i) arena.run([] { expectAll(5, nicenessOfLoop(kThreads)); });
  }).join();
}

/// As a cycle does, on TBB's threads.
void expectNormalOutside() {
  tbb::task_arena(kThreads).execute([] { expectAll(0, nicenessOfLoop(kThreads)); });
}

/// Another test, or who runs this, may have lowered this thread for good.
bool isLowered() {
  return getpriority(PRIO_PROCESS, 0) != 0;
}

class WorkArenaTest : public ::testing::Test {
  const tbb::global_control threads_{tbb::global_control::max_allowed_parallelism, kThreads};
};

/// TBB's threads stay, so ctest runs each of these in a process of its own.
TEST_F(WorkArenaTest, ThreadsThatServeCyclesAreNotLoweredByWorkBefore) {
  if (isLowered()) GTEST_SKIP();
  expectLowInArena();
  expectNormalOutside();
}

TEST_F(WorkArenaTest, ThreadsThatHaveServedCyclesAreNotLoweredByWork) {
  if (isLowered()) GTEST_SKIP();
  expectNormalOutside();
  if (isLowered()) GTEST_SKIP();
  expectLowInArena();
  expectNormalOutside();
}

TEST_F(WorkArenaTest, DoesWorkOfSeveralCallersOneAfterTheOther) {
  WorkArena arena(kThreads);
  std::atomic<int> at_work{0}, sum{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&] {
      for (int i = 0; i < 200; ++i) {
        arena.run([&] {
          EXPECT_EQ(++at_work, 1);
          parallelFor(0, 10, [&](int) { parallelFor(0, 10, [&](int) { ++sum; }); });
          --at_work;
        });
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 4 * 200 * 100);
}

TEST_F(WorkArenaTest, WorkEndsByExceptionsAndCancellation) {
  WorkArena arena(kThreads);
  EXPECT_THROW(arena.run([] { parallelFor(0, 100, [](int) { throw std::runtime_error("no"); }); }), std::runtime_error);
  std::atomic<bool> stop{false};
  const CancelScope scope(stop);
  EXPECT_THROW(arena.run([&] {
    parallelFor(0, 100, [&](int) {
      stop = true;
      checkCancelled();
    });
  }),
               Cancelled);
  bool is_waiting_cancelled = false;
  arena.run([&] {  // another caller waits
    std::thread([&] {
      const CancelScope waiting(stop);
      try {
        arena.run([] {});
      } catch (const Cancelled&) {
        is_waiting_cancelled = true;
      }
    }).join();
  });
  EXPECT_TRUE(is_waiting_cancelled);
}

}  // namespace sdf_ccd::work_arena_test
