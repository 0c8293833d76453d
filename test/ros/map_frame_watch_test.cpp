#include "ros/monitor/map_frame_watch.h"

#include <gtest/gtest.h>

#include "ros/tf_messages.h"

namespace sdf_ccd::map_frame_watch_test {

using test::message;
using test::stampedTransform;

/// The robot at a place in the map [m].
std::vector<BodyInMap> robotAt(double x) {
  BodyInMap body;
  body.X_BM.translation().x() = -x;
  body.is_at_stamp = true;
  return {body};
}

constexpr double kLimit = 0.05;

/// The localisation in "map" is corrected; the robot drives in "odom".
TEST(MapFrameWatch, ACorrectedLocalisationIsAMotionADrivingRobotIsNone) {
  for (const std::string fixed : {"base", "odom"}) {
    TfHistory history(fixed);
    MapFrameWatch watch(history, "base"), watch_odom(history, "base");
    const auto send = [&](double time, double correction, double driven) {
      history.add(
          message({stampedTransform("map", "odom", time, correction), stampedTransform("odom", "base", time, driven)}),
          false);
    };
    double driven = 0.0;
    for (int t = 100; t < 110; ++t, driven += 0.5) {
      send(t, 1.0, driven);
      EXPECT_FALSE(watch.hasMoved("map", ros::Time(t), robotAt(1.0 + driven), kLimit)) << fixed << t;
      if (fixed == "base") {
        EXPECT_FALSE(watch_odom.hasMoved("odom", ros::Time(t), robotAt(driven), kLimit)) << t;
      }
    }
    send(110, 1.04, driven);
    EXPECT_FALSE(watch.hasMoved("map", ros::Time(110), robotAt(1.0 + driven), kLimit)) << fixed;
    send(111, 1.06, driven);
    EXPECT_TRUE(watch.hasMoved("map", ros::Time(111), robotAt(1.0 + driven), kLimit)) << fixed;
    EXPECT_FALSE(watch.hasMoved("map", ros::Time(111), robotAt(1.0 + driven), kLimit)) << fixed;
    send(112, 1.10, driven);
    EXPECT_FALSE(watch.hasMoved("map", ros::Time(112), robotAt(1.0 + driven), kLimit)) << fixed;
    EXPECT_FALSE(watch.isCarried()) << fixed;
  }
}

/// Without odometry, nothing tells one from the other.
TEST(MapFrameWatch, ARobotThatIsLocalisedDirectlyDrives) {
  TfHistory history("base");
  MapFrameWatch watch(history, "base");
  for (int t = 100; t < 110; ++t) {
    history.add(message({stampedTransform("map", "base", t, 0.5 * t)}), false);
    EXPECT_FALSE(watch.hasMoved("map", ros::Time(t), robotAt(0.5 * t), kLimit)) << t;
  }
}

/// The map of a camera on a moving arm: its voxels are elsewhere in each map.
TEST(MapFrameWatch, AFrameThatTheRobotCarriesMoves) {
  TfHistory history("base");
  MapFrameWatch watch(history, "base");
  int moved = 0;
  for (int t = 100; t < 120; ++t) {
    history.add(message({stampedTransform("base", "camera", t, 0.02 * t)}), false);
    moved += watch.hasMoved("camera", ros::Time(t), robotAt(0.0), kLimit);
  }
  EXPECT_EQ(moved, 6);  // 0.38 m
  EXPECT_TRUE(watch.isCarried());
  EXPECT_FALSE(watch.hasMoved("nowhere", ros::Time(119), robotAt(0.0), kLimit));
  EXPECT_FALSE(watch.hasMoved("base", ros::Time(119), robotAt(0.0), kLimit));
  EXPECT_FALSE(watch.isCarried());
}

}  // namespace sdf_ccd::map_frame_watch_test
