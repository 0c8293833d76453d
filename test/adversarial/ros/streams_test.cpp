#include <gtest/gtest.h>

#include "adversarial/ros/ros_family.h"

namespace sdf_ccd::test::streams_test {

TEST(Streams, NeverMakeAVerdictUntrue) {
  constexpr long kCases = 2000;
  const Tally tally = rosStreams(1, kCases);
  for (const auto& [what, failure] : tally.failures)
    ADD_FAILURE() << failure.count << " of " << tally.cases << ": " << what << ", the first " << failure.first;
  EXPECT_TRUE(tally.holds());
  EXPECT_GT(tally.clear, kCases / 10);
  EXPECT_GT(tally.contact, kCases / 50);
}

}  // namespace sdf_ccd::test::streams_test
