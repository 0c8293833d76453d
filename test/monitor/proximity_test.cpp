#include "monitor/proximity.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

namespace sdf_ccd::proximity_test {

TEST(Proximity, RisesAtOnceAndFallsBehindTheHysteresis) {
  ProximityWatch watch;
  const std::vector<std::pair<double, Proximity>> told = {
      {0.2, Proximity::kFree},      {0.105, Proximity::kFree},    {0.099, Proximity::kWarning},
      {0.105, Proximity::kWarning}, {0.111, Proximity::kFree},    {0.0, Proximity::kStop},
      {0.029, Proximity::kStop},    {0.031, Proximity::kWarning}, {0.025, Proximity::kWarning},
      {0.019, Proximity::kStop},    {0.2, Proximity::kFree}};
  for (const auto& [distance, level] : told)
    EXPECT_EQ(watch.update(distance - 0.1, distance - 0.02, 0.01), level) << distance;
}

TEST(Proximity, ALevelThatIsNotWatchedIsNeverReached) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  ProximityWatch watch;
  EXPECT_EQ(watch.update(kNever, kNever, 0.01), Proximity::kFree);
  EXPECT_EQ(watch.update(-0.1, kNever, 0.01), Proximity::kWarning);
  EXPECT_EQ(watch.update(0.005, kNever, 0.01), Proximity::kWarning);
  EXPECT_EQ(watch.update(kNever, -0.1, 0.01), Proximity::kStop);
  EXPECT_EQ(watch.update(kNever, kNever, 0.01), Proximity::kFree);
}

}  // namespace sdf_ccd::proximity_test
