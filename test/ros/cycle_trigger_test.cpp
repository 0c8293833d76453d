#include "ros/tf/cycle_trigger.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

namespace sdf_ccd::cycle_trigger_test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using Clock = std::chrono::steady_clock;

TEST(CycleTrigger, AGridStaysWhereItIsHoweverLateACycleBegins) {
  const nanoseconds period(1000000);
  nanoseconds due(500);
  for (int i = 0; i < 1000; ++i) {
    const nanoseconds late = due + nanoseconds(123456 + 1700000 * (i % 7 == 0));
    const nanoseconds next = nextOnGrid(due, late, period);
    EXPECT_GT(next, late);
    EXPECT_LE(next, late + period);
    EXPECT_EQ((next - nanoseconds(500)) % period, nanoseconds(0));
    due = next;
  }
}

TEST(CycleTrigger, EventsAtTheRateBeginACycleEachHoweverTheyJitter) {
  const nanoseconds period(1000000), start(3600000000000);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> late(0, 450000);
  nanoseconds due(0), last(0);
  int cycles = 0;
  for (int event = 0; event < 60000;) {
    // A cycle begins 50 us after it may, and contains all events that have come by then.
    const nanoseconds arrived = start + event * period + nanoseconds(late(random));
    const nanoseconds begun = std::max(arrived, due) + nanoseconds(50000);
    if (cycles > 0) {
      EXPECT_GE(begun - last, period / 2);
    }
    while (start + event * period <= begun) ++event;
    last = begun;
    ++cycles;
    due = dueAfter(due, begun, period);
  }
  EXPECT_GT(cycles, 59940);
  EXPECT_LE(cycles, 60000);
}

TEST(CycleTrigger, EventsFasterThanTheRateDoNotExceedIt) {
  const nanoseconds period(1000000), start(3600000000000);
  nanoseconds due(0), now = start;
  int cycles = 0;
  for (; now < start + 1000 * period; now += nanoseconds(10000)) {
    if (now < due) continue;
    due = dueAfter(due, now, period);
    ++cycles;
  }
  EXPECT_LE(cycles, 1002);
  EXPECT_GE(cycles, 990);
}

TEST(CycleTrigger, ATimerIsNeverEarlyAndDoesNotDrift) {
  CycleTrigger trigger;
  trigger.setOptions({TriggerKind::kTimer, {}, 0.001, 0.1});
  ASSERT_TRUE(trigger.wait());
  const auto start = Clock::now();
  int cycles = 0;
  while (Clock::now() - start < milliseconds(500)) {
    ASSERT_TRUE(trigger.wait());
    ++cycles;
  }
  const double elapsed = std::chrono::duration<double>(Clock::now() - start).count();
  EXPECT_LE(cycles, elapsed / 0.001 + 1.0);
}

TEST(CycleTrigger, AHigherRateHoldsForWhoWaitsAlready) {
  CycleTrigger trigger;
  trigger.setOptions({TriggerKind::kTimer, {}, 1000.0, 0.1});
  ASSERT_TRUE(trigger.wait());
  const auto start = Clock::now();
  std::thread setter([&] {
    std::this_thread::sleep_for(milliseconds(50));
    trigger.wake();
  });
  int cycles = 0;
  const auto setRate = [&] { trigger.setOptions({TriggerKind::kTimer, {}, 0.01, 0.1}); };
  while (cycles < 20 && trigger.wait(setRate)) ++cycles;
  setter.join();
  EXPECT_EQ(cycles, 20);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
}

/// Number of cycles that begin while events are brought.
template <class Bring>
int cyclesWhile(const TriggerOptions& options, int times, const Bring& bring) {
  CycleTrigger trigger;
  trigger.setOptions(options);
  std::atomic<int> cycles{0};
  std::thread thread([&] {
    while (trigger.wait()) ++cycles;
  });
  while (cycles == 0) std::this_thread::yield();  // the first begins at once
  cycles = 0;
  for (int i = 0; i < times; ++i) {
    bring(trigger, i);
    std::this_thread::sleep_for(milliseconds(20));
  }
  const int counted = cycles;
  trigger.stop();
  thread.join();
  return counted;
}

TEST(CycleTrigger, EachEventBeginsACycleOfItsOwn) {
  constexpr double kLong = 1e3;
  const auto transforms = [](CycleTrigger& trigger, int) { trigger.onTransforms(); };
  const auto joints = [](CycleTrigger& trigger, int) { trigger.onJointStates(); };
  EXPECT_EQ(cyclesWhile({TriggerKind::kTf, {}, 1e-3, kLong}, 5, transforms), 5);
  EXPECT_EQ(cyclesWhile({TriggerKind::kTf, {}, 1e-3, kLong}, 5, joints), 0);
  EXPECT_EQ(cyclesWhile({TriggerKind::kJointStates, {}, 1e-3, kLong}, 5, joints), 5);
  // The last of a group, whichever that is.
  const auto frames = [](CycleTrigger& trigger, int i) {
    const char* const order[] = {"a", "a", "b", "other", "b", "a"};
    trigger.onFrame(order[i]);
  };
  EXPECT_EQ(cyclesWhile({TriggerKind::kFrames, {"a", "b"}, 1e-3, kLong}, 6, frames), 2);
}

TEST(CycleTrigger, AFrameOfTheGroupThatNeverComesIsNamed) {
  CycleTrigger trigger;
  EXPECT_EQ(trigger.awaitedFrame(), "");
  TriggerOptions options{TriggerKind::kFrames, {"a", "b"}, 1e-3, 1e-3};
  trigger.setOptions(options);
  EXPECT_EQ(trigger.awaitedFrame(), "a");
  trigger.onFrame("a");
  trigger.onFrame("other");
  ASSERT_TRUE(trigger.wait() && trigger.wait());  // the first of a cycle that has begun without it counts, too
  EXPECT_EQ(trigger.awaitedFrame(), "b");
  options.period = 2e-3;
  trigger.setOptions(options);
  trigger.onFrame("b");
  EXPECT_EQ(trigger.awaitedFrame(), "");
  options.frames = {"c"};
  trigger.setOptions(options);
  EXPECT_EQ(trigger.awaitedFrame(), "c");
  options.kind = TriggerKind::kTimer;
  trigger.setOptions(options);
  EXPECT_EQ(trigger.awaitedFrame(), "");
}

TEST(CycleTrigger, EventsBeginNoMoreCyclesThanTheRateAndSilenceEndsByPatience) {
  const auto storm = [](CycleTrigger& trigger, int) {
    for (int i = 0; i < 50; ++i) trigger.onTransforms();
  };
  EXPECT_LE(cyclesWhile({TriggerKind::kTf, {}, 0.1, 1e3}, 10, storm), 5);
  const auto silence = [](CycleTrigger&, int) {};
  EXPECT_GE(cyclesWhile({TriggerKind::kTf, {}, 1e-3, 0.01}, 10, silence), 2);
}

TEST(CycleTrigger, StopEndsAllWaiting) {
  CycleTrigger trigger;
  trigger.setOptions({TriggerKind::kTimer, {}, 1e9, 0.1});
  EXPECT_TRUE(trigger.wait());
  std::thread stops([&] {
    std::this_thread::sleep_for(milliseconds(20));
    trigger.stop();
  });
  EXPECT_FALSE(trigger.wait());
  EXPECT_FALSE(trigger.waitFor(1e9));
  stops.join();
}

}  // namespace sdf_ccd::cycle_trigger_test
