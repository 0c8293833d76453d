#include "ros/tf/seconds_between.h"

#include <gtest/gtest.h>

#include "ros/tf/tf_edge.h"

namespace sdf_ccd::seconds_between_test {

TEST(SecondsBetween, EqualsTheDifferenceWhereThereIsOne) {
  for (const ros::Time& from : {ros::Time(0, 0), ros::Time(7, 999999999), ros::Time(1700000000, 1)}) {
    for (const ros::Time& to : {ros::Time(0, 1), ros::Time(8, 0), ros::Time(1700000000, 123456789)}) {
      EXPECT_EQ(secondsBetween(from, to), (to - from).toSec()) << from << " " << to;
    }
  }
}

TEST(SecondsBetween, ReachesFartherThanADuration) {
  EXPECT_EQ(secondsBetween(ros::Time(), ros::TIME_MAX), 4294967295.999999999);
  EXPECT_EQ(secondsBetween(ros::TIME_MAX, ros::Time()), -4294967295.999999999);
  EXPECT_EQ(secondsBetween(ros::Duration(-2147483648.0), ros::Duration(2147483647.0)), 4294967295.0);
}

TEST(Before, EqualsTheDifferenceAndEndsAtZero) {
  for (const ros::Time& time : {ros::Time(7, 999999999), ros::Time(1700000000, 1), ros::TIME_MAX}) {
    for (const ros::Duration& duration : {ros::Duration(0, 0), ros::Duration(0, 2), ros::Duration(7, 999999998)})
      EXPECT_EQ(before(time, duration), time - duration) << time << " " << duration;
  }
  EXPECT_EQ(before(ros::Time(7, 3), ros::Duration(7, 3)), ros::Time());
  EXPECT_EQ(before(ros::Time(7, 3), ros::Duration(8, 0)), ros::Time());
}

}  // namespace sdf_ccd::seconds_between_test
