
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

#include "common/cancel_point.h"
#include "common/parallel_for.h"

namespace sdf_ccd::cancel_test {

TEST(Cancel, WithoutAScopeNothingIsCancelled) {
  EXPECT_NO_THROW(checkCancelled());
  EXPECT_FALSE(CancelPoint().requested());
}

TEST(Cancel, PassesHandlersOfFailures) {
  const std::atomic<bool> asked{true};
  const CancelScope scope(asked);
  const auto work = [] {
    try {
      checkCancelled();
    } catch (const std::exception&) {
      FAIL() << "taken for a failure";
    }
  };
  EXPECT_THROW(work(), Cancelled);
}

TEST(Cancel, TheInnerScopeCounts) {
  const std::atomic<bool> asked{true}, not_asked{false};
  const CancelScope outer(asked);
  {
    const CancelScope inner(not_asked);
    EXPECT_NO_THROW(checkCancelled());
  }
  EXPECT_THROW(checkCancelled(), Cancelled);
}

TEST(Cancel, ComesWithTheEarlierDeadline) {
  using Clock = CancelRequest::Clock;
  const std::atomic<bool> not_asked{false};
  const CancelScope outer(Clock::now() - std::chrono::seconds(1));
  const CancelScope flag(not_asked), later(Clock::now() + std::chrono::hours(1));
  EXPECT_THROW(checkCancelled(), Cancelled);
}

TEST(Cancel, NoDeadlineBeforeItsTime) {
  const CancelScope scope(CancelRequest::Clock::now() + std::chrono::hours(1));
  EXPECT_NO_THROW(checkCancelled());
}

TEST(Cancel, ReachesWhatTasksOnOtherThreadsCall) {
  std::atomic<bool> asked{false};
  const CancelScope scope(asked);
  std::atomic<int> done{0};
  const auto work = [&] {
    parallelFor(0, 8, [&](int) {
      for (int i = 0; i < 100000000; ++i) {
        checkCancelled();
        if (++done == 100) asked = true;
      }
    });
  };
  EXPECT_THROW(work(), Cancelled);
  EXPECT_LT(done, 100000000);
  EXPECT_THROW(checkCancelled(), Cancelled) << "the caller's own request is as it was";
}

TEST(Cancel, ReachesTasksOnOtherThreads) {
  std::atomic<bool> asked{false};
  const CancelScope scope(asked);
  const CancelPoint cancel;
  std::atomic<int> done{0};
  const auto work = [&] {
    tbb::parallel_for(0, 1000000, [&](int) {
      cancel.check();
      if (++done == 100) asked = true;
    });
  };
  EXPECT_THROW(work(), Cancelled);
  EXPECT_LT(done, 1000000);
}

}  // namespace sdf_ccd::cancel_test
