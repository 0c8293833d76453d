// A node may include the library and all messages but Verdict.h: no other name is taken twice, and the numbers of that
// message are those of the library's enumeration, which has its name.

#include <gtest/gtest.h>

#include "robot_monitor/check_motion.h"
#include "ros/messages/conversions.h"
#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/GetPlan.h"
#include "sdf_ccd/MonitorState.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/QueryMotions.h"
#include "sdf_ccd/QueryPoints.h"
#include "sdf_ccd/UpdateScene.h"
#include "sdf_ccd/WaysOut.h"
#include "sdf_ccd/robot_scene.h"
#include "sdf_ccd/sdf_ccd.h"
#define Verdict VerdictMessage
#include "sdf_ccd/Verdict.h"
#undef Verdict

namespace sdf_ccd::message_names_test {

TEST(Messages, AZeroedOneSaysNotChecked) {
  EXPECT_EQ(PairContact().verdict, numberOf(Verdict::kNotChecked));
  EXPECT_EQ(ContactArray().verdict, numberOf(Verdict::kNotChecked));
  EXPECT_EQ(MonitorState().verdict, numberOf(Verdict::kNotChecked));
  EXPECT_EQ(QueryMotionResponse().verdict, numberOf(Verdict::kNotChecked));
  EXPECT_EQ(CheckedMotion().verdict, numberOf(Verdict::kNotChecked));
}

TEST(Messages, VerdictsHaveTheLibrarysNumbers) {
  EXPECT_EQ(numberOf(Verdict::kNotChecked), VerdictMessage::NOT_CHECKED);
  EXPECT_EQ(numberOf(Verdict::kClear), VerdictMessage::CLEAR);
  EXPECT_EQ(numberOf(Verdict::kUncertain), VerdictMessage::UNCERTAIN);
  EXPECT_EQ(numberOf(Verdict::kContact), VerdictMessage::CONTACT);
}

/// As in moveit_msgs/CollisionObject, whose users may write the numbers.
TEST(Messages, ChangesBeginWithMoveItsOperations) {
  EXPECT_EQ(SceneChange::ADD, 0);
  EXPECT_EQ(SceneChange::REMOVE, 1);
  EXPECT_EQ(SceneChange::APPEND, 2);
  EXPECT_EQ(SceneChange::MOVE, 3);
}

}  // namespace sdf_ccd::message_names_test
