#include "ros/monitor/work_turns.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace sdf_ccd {
namespace {

TEST(WorkTurns, OneMoreCallerThanAllowedIsRefused) {
  WorkTurns turns(2);
  const WorkTurns::Caller first(turns);
  {
    const WorkTurns::Caller second(turns);
    EXPECT_THROW(WorkTurns::Caller third(turns), std::runtime_error);
  }
  EXPECT_NO_THROW(WorkTurns::Caller third(turns));
}

TEST(WorkTurns, AShortWorkIsDoneBetweenThePiecesOfALongOne) {
  constexpr int kPieces = 200;
  WorkTurns turns(2);
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

}  // namespace
}  // namespace sdf_ccd
