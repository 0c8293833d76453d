#include "ros/monitor/current_poses.h"

#include <gtest/gtest.h>

namespace sdf_ccd::current_poses_test {

TEST(CurrentPoses, OldTransformsAreSaid) {
  CurrentPoses now;
  now.oldest = ros::Time(100.0);
  now.oldest_frame = "rod";
  EXPECT_EQ(oldTransformsNote(now, ros::Time(100.4), 0.5), "");
  EXPECT_EQ(oldTransformsNote(now, ros::Time(90.0), 0.5), "");
  EXPECT_EQ(oldTransformsNote(now, ros::Time(112.5), 0.5), "the newest transform of rod is 12.5 s old");
  now.oldest = ros::Time();
  EXPECT_EQ(oldTransformsNote(now, ros::Time(112.5), 0.5), "");
}

}  // namespace sdf_ccd::current_poses_test
