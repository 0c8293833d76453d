// A node may include the library and all messages: none of their names is taken twice. Verdicts have the same numbers.

#include <gtest/gtest.h>

#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/GetPlan.h"
#include "sdf_ccd/MonitorState.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/QueryMotions.h"
#include "sdf_ccd/QueryPoints.h"
#include "sdf_ccd/UpdateScene.h"
#include "sdf_ccd/Verdicts.h"
#include "sdf_ccd/WaysOut.h"
#include "sdf_ccd/robot_monitor/check_motion.h"
#include "sdf_ccd/robot_scene.h"
#include "sdf_ccd/sdf_ccd.h"

namespace sdf_ccd::message_names_test {

TEST(Messages, AZeroedOneSaysNotChecked) {
  EXPECT_EQ(PairContact().verdict, Verdicts::NOT_CHECKED);
  EXPECT_EQ(ContactArray().verdict, Verdicts::NOT_CHECKED);
  EXPECT_EQ(MonitorState().verdict, Verdicts::NOT_CHECKED);
  EXPECT_EQ(QueryMotionResponse().verdict, Verdicts::NOT_CHECKED);
  EXPECT_EQ(CheckedMotion().verdict, Verdicts::NOT_CHECKED);
  EXPECT_EQ(static_cast<int>(Verdict::kNotChecked), Verdicts::NOT_CHECKED);
}

/// As in moveit_msgs/CollisionObject, whose users may write the numbers.
TEST(Messages, ChangesBeginWithMoveItsOperations) {
  EXPECT_EQ(SceneChange::ADD, 0);
  EXPECT_EQ(SceneChange::REMOVE, 1);
  EXPECT_EQ(SceneChange::APPEND, 2);
  EXPECT_EQ(SceneChange::MOVE, 3);
}

}  // namespace sdf_ccd::message_names_test
