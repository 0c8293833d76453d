#include "monitor/map/map_distances.h"

#include <gtest/gtest.h>

namespace sdf_ccd::map_distances_test {

TEST(MapDistances, OnlyDistancesBelowThePaddingAreNamed) {
  ProximityThresholds thresholds;
  EXPECT_EQ(distancesWithinPadding(thresholds, 0.05), "");  // 0: nothing is to be kept
  thresholds.stop = 0.05;
  thresholds.warning = 0.1;
  EXPECT_EQ(distancesWithinPadding(thresholds, 0.05), "");
  thresholds.stop = 0.04;
  EXPECT_EQ(distancesWithinPadding(thresholds, 0.05).find("stop_distance (0.04 m) below octomap/padding (0.05 m)"), 0u);
  EXPECT_EQ(distancesWithinPadding(thresholds, 0.2).find("stop_distance (0.04 m) and warning_distance (0.1 m) below"),
            0u);
}

}  // namespace sdf_ccd::map_distances_test
