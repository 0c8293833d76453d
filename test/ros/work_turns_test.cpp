#include "ros/monitor/work_turns.h"
#include "common/cancel_point.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sdf_ccd::work_turns_test {

TEST(WorkTurns, OneMoreCallerThanAllowedIsRefused) {
  WorkTurns turns(2, "calls");
  const WorkTurns::Caller first(turns);
  {
    const WorkTurns::Caller second(turns);
    EXPECT_THROW(WorkTurns::Caller third(turns), std::runtime_error);
  }
  EXPECT_NO_THROW(WorkTurns::Caller third(turns));
}

TEST(WorkTurns, AShortWorkIsDoneBetweenThePiecesOfALongOne) {
  constexpr int kPieces = 200;
  WorkTurns turns(2, "calls");
  std::atomic<int> done{0}, at_once{0}, most{0};
  std::atomic<bool> is_short_done{false};
  const auto piece = [&] {
    const WorkTurns::Turn turn(turns);
    most = std::max<int>(most, ++at_once);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --at_once;
  };
  std::thread long_work([&] {
    for (int i = 0; i < kPieces; ++i, ++done) piece();
  });
  while (done < 5) std::this_thread::yield();
  const int before = done;
  piece();
  const int after = done;
  long_work.join();
  EXPECT_LE(after - before, 3);
  EXPECT_EQ(most, 1);
}

TEST(WorkTurns, WhoIsCancelledWaitsNoLonger) {
  WorkTurns turns(2, "calls");
  auto first = std::make_unique<WorkTurns::Turn>(turns);
  std::thread waiting([&] {
    const CancelScope scope(CancelRequest::Clock::now() + std::chrono::milliseconds(50));
    EXPECT_THROW(WorkTurns::Turn second(turns), Cancelled);
  });
  waiting.join();
  first.reset();
  EXPECT_NO_THROW(WorkTurns::Turn third(turns)) << "the one that waited has left";
}

}  // namespace sdf_ccd::work_turns_test
