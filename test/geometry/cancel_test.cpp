#include "sdf_ccd/geometry/cancel.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <stdexcept>

namespace sdf_ccd {
namespace {

TEST(Cancel, WithoutAScopeNothingIsCancelled) {
  EXPECT_NO_THROW(checkCancelled());
  EXPECT_FALSE(CancelPoint().asked());
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

}  // namespace
}  // namespace sdf_ccd
