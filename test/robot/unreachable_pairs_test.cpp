#include "robot/unreachable_pairs.h"

#include <gtest/gtest.h>

#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd::unreachable_pairs_test {

/// Two balls of 0.1 m radius at both ends of a rail of 3 m, one of which slides by 1 m.
const char* const kRail = R"(<robot name='r'>
  <link name='base'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <link name='arm'/>
  <link name='ball'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <joint name='slide' type='prismatic'><parent link='base'/><child link='arm'/><origin xyz='3 0 0'/>
    <axis xyz='2 0 0'/><limit lower='-1' upper='0' effort='1' velocity='1'/></joint>
  <joint name='turn' type='continuous'><parent link='arm'/><child link='ball'/><axis xyz='0 0 1'/></joint>
</robot>)";

class UnreachablePairsTest : public ::testing::Test {
 protected:
  UnreachablePairsTest() : robot_(kRail) {
    std::vector<std::string> warnings;
    scene_ = describeRobot(robot_, {}, {}, {}, warnings);
    pairs_ = unreachablePairs(scene_.bodies, scene_.allowed);
  }

  std::string along(double from, double to) const {
    const RobotTrajectory named = {{0.0, 1.0}, {{{}, {{"slide", from}}, {}}, {{}, {{"slide", to}}, {}}}};
    return along(completePlan(robot_, named, {}, {true}), {{0, {}, {}}, {2, {}, {}}});
  }

  std::string along(const PlannedJoints& plan, const std::vector<CarriedBody>& bodies) const {
    return JointReach(robot_, plan, bodies).whyReachable(pairs_.at(0));
  }

  RobotModel robot_;
  SceneDescription scene_;
  std::vector<UnreachablePair> pairs_;
};

TEST_F(UnreachablePairsTest, RestOnTheLimitsOfPrismaticJoints) {
  ASSERT_EQ(pairs_.size(), 1u);
  EXPECT_EQ(scene_.bodies[pairs_[0].body_a].name, "base");
  EXPECT_EQ(scene_.bodies[pairs_[0].body_b].name, "ball");
  EXPECT_NEAR(pairs_[0].ball_b.radius, std::sqrt(0.03), 1e-12);  // from the ball's box
  ASSERT_EQ(pairs_[0].slides.size(), 1u);
  EXPECT_EQ(pairs_[0].slides[0].joint, "slide");
  EXPECT_NEAR(pairs_[0].slides[0].low, -1.1, 1e-12);
  EXPECT_NEAR(pairs_[0].slides[0].high, 0.1, 1e-12);
}

TEST_F(UnreachablePairsTest, AreUncheckedWhereAJointGoesBeyond) {
  EXPECT_EQ(along(-1.09, 0.09), "");
  // Through the other ball.
  EXPECT_EQ(along(-3.0, 0.0), "out of reach only while joint slide is in [-1.1, 0.1]; it is at -3");
  EXPECT_EQ(along(0.0, 0.2), "out of reach only while joint slide is in [-1.1, 0.1]; it is at 0.2");
  CurrentJoints now;  // no current positions
  const RobotTrajectory named = {{0.0, 1.0}, std::vector<RobotState>(2)};
  const std::vector<CarriedBody> carried = {{0, {}, {}}, {2, {}, {}}};
  EXPECT_EQ(along(completePlan(robot_, named, now, {}), carried), "out of reach by joint slide, which is not known");
  now.X_PL["slide"] = Isometry3d(Eigen::Translation3d(2.0, 0.0, 0.0));
  EXPECT_EQ(along(completePlan(robot_, named, now, {}), carried), "");
  EXPECT_NE(along(completePlan(robot_, named, now, {}), {{-1, {}, {}}, {2, {}, {}}}), "") << "not on the robot";
  now.X_PL["slide"] = Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.0));
  EXPECT_NE(along(completePlan(robot_, named, now, {}), carried), "");
}

TEST_F(UnreachablePairsTest, AreUncheckedWherePosesMayBringThemTogether) {
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.missing.resize(2);
  const auto may = [&](double from, double to) {
    motion.X_WB = {{Isometry3d::Identity(), Isometry3d::Identity()},
                   {Isometry3d(Eigen::Translation3d(from, 0, 0)), Isometry3d(Eigen::Translation3d(to, 0, 0))}};
    return !whyReachable(motion, {false, true}, pairs_.at(0)).empty();
  };
  EXPECT_FALSE(may(3.0, 2.0));
  EXPECT_FALSE(may(1.0, 0.35));
  EXPECT_TRUE(may(1.0, 0.34));
  EXPECT_TRUE(may(3.0, -3.0));
  motion.missing[0] = "no transform";
  EXPECT_TRUE(may(3.0, 2.0));
  EXPECT_EQ(whyReachable(motion, {false, false}, pairs_.at(0)), "");
}

TEST(RigidlyJoinedPairs, AreUncheckedWherePosesMoveThem) {
  const RobotModel robot(R"(<robot name='r'>
    <link name='world'/>
    <link name='base'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
    <joint name='stands' type='fixed'><parent link='world'/><child link='base'/><origin xyz='0 0 1'/></joint>
    </robot>)");
  std::vector<std::string> warnings;
  SceneDescription scene = describeRobot(robot, {}, {}, {}, warnings);
  BodyDescription table;
  table.name = "table";
  table.frame = "world";
  table.X_frame_B.translation() = Vector3d(3.0, 0.0, 0.0);
  table.geometry.emplace_back();
  table.geometry.back().shape = Primitive(Box{{0.1, 0.1, 0.1}});
  table.is_world = true;
  scene.bodies.push_back(table);
  disableUnreachable(robot, scene);
  const std::vector<UnreachablePair> pairs = unreachablePairs(scene.bodies, scene.allowed);
  ASSERT_EQ(pairs.size(), 1u);
  ASSERT_TRUE(pairs[0].X_AB);
  EXPECT_TRUE(pairs[0].X_AB->translation().isApprox(Vector3d(3.0, 0.0, -1.0)));
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.missing.resize(2);
  motion.X_WB = {{Isometry3d(Eigen::Translation3d(0, 0, 1))}, {Isometry3d(Eigen::Translation3d(3, 0, 0))}};
  EXPECT_EQ(whyReachable(motion, {true, false}, pairs[0]), "");
  motion.X_WB[0].push_back(Isometry3d(Eigen::Translation3d(3, 0, 0)));
  EXPECT_EQ(whyReachable(motion, {true, false}, pairs[0]), "rigidly joined in the URDF, but not in these poses");
  EXPECT_EQ(whyReachable(motion, {false, false}, pairs[0]), "");
}

}  // namespace sdf_ccd::unreachable_pairs_test
