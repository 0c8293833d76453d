#include "monitor/proximity.h"

#include <gtest/gtest.h>

#include <vector>

namespace sdf_ccd {
namespace {

TEST(Proximity, RisesAtOnceAndFallsBehindTheHysteresis) {
  const ProximityThresholds thresholds{0.1, 0.02, 0.01};
  EXPECT_DOUBLE_EQ(thresholds.range(), 0.11);
  ProximityWatch watch;
  const std::vector<std::pair<double, Proximity>> told = {
      {0.2, Proximity::kFree},      {0.105, Proximity::kFree},    {0.099, Proximity::kWarning},
      {0.105, Proximity::kWarning}, {0.111, Proximity::kFree},    {0.0, Proximity::kStop},
      {0.029, Proximity::kStop},    {0.031, Proximity::kWarning}, {0.025, Proximity::kWarning},
      {0.019, Proximity::kStop},    {0.2, Proximity::kFree}};
  for (const auto& [distance, level] : told) EXPECT_EQ(watch.update(distance, thresholds), level) << distance;
}

TEST(Proximity, WithoutThresholdsNothingIsWatched) {
  ProximityWatch watch;
  EXPECT_EQ(watch.update(0.0, {}), Proximity::kNotWatched);
  EXPECT_EQ(ProximityThresholds{}.range(), 0.0);
  EXPECT_EQ(watch.update(0.05, {0.1, 0.0, 0.0}), Proximity::kWarning);
  EXPECT_EQ(watch.update(0.0, {0.1, 0.0, 0.0}), Proximity::kWarning);
}

}  // namespace
}  // namespace sdf_ccd
