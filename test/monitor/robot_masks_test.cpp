#include "monitor/map/robot_masks.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::robot_masks_test {

using namespace test;

/// What a mask hides depends on when its body was where it is in the map.
TEST(RobotMasks, OnlyAPoseAtTheMapsStampHidesWhatIsOccupied) {
  BodyDescription unread = body("unread", Primitive(Sphere{0.1}));
  unread.failure = "its mesh cannot be read";
  const SceneDescription description{{body("ball", Primitive(Sphere{0.1})), unread}, {}};
  const auto scene = build(description, fine(0.02));
  BodyInMap at_stamp, now, grasped;
  at_stamp.is_at_stamp = true;
  at_stamp.X_BM.translation().x() = -2.0;
  grasped.was_elsewhere = true;
  BodyInMap failed = at_stamp;
  failed.body = 1;
  const RobotMasks found = robotMasks(*scene, description, {at_stamp, failed, now, grasped});
  EXPECT_EQ(found.without_field, "");
  ASSERT_EQ(found.masks.size(), 3u);
  EXPECT_NEAR((found.masks[0].center_M - Vector3d(2.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_FALSE(found.masks[0].only_unknown || found.masks[0].is_guess);
  EXPECT_TRUE(found.masks[1].only_unknown && found.masks[1].is_guess);
  EXPECT_TRUE(found.masks[2].only_unknown && !found.masks[2].is_guess);
}

}  // namespace sdf_ccd::robot_masks_test
