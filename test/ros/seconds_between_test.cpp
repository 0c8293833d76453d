#include "ros/tf/seconds_between.h"

#include <gtest/gtest.h>

namespace sdf_ccd {
namespace {

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

}  // namespace
}  // namespace sdf_ccd
