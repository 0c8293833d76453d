#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "robot_monitor/describe_robot_case.h"

namespace sdf_ccd::robot_pairs_test {

using namespace test;

TEST(DescribeRobot, RigidAndAdjacentLinksAreNoPairs) {
  const SceneDescription scene = describe(chain()).scene;
  EXPECT_EQ(reasonFor(scene, "c", "d"), "rigidly joined");
  EXPECT_EQ(reasonFor(scene, "a", "b"), "adjacent");
  EXPECT_EQ(reasonFor(scene, "b", "d"), "checked") << "however far apart";
  EXPECT_EQ(reasonFor(scene, "a", "c"), "checked");
  RobotPairOptions options;
  options.check_adjacent = true;
  const SceneDescription adjacent = describe(chain(), {}, options).scene;
  EXPECT_EQ(reasonFor(adjacent, "c", "d"), "rigidly joined");
  EXPECT_EQ(reasonFor(adjacent, "a", "b"), "checked");
}

TEST(DescribeRobot, SrdfDisablesAndEnables) {
  Srdf srdf = parseSrdf(R"(<robot name="chain">
      <disable_collisions link1="c" link2="a" reason="Never"/>
      <disable_collisions link1="ghost" link2="a" reason="Never"/>
      <disable_default_collisions link="d"/></robot>)");
  const Described disabled = describe(chain(), srdf);
  EXPECT_EQ(reasonFor(disabled.scene, "a", "c"), "SRDF: Never");
  EXPECT_EQ(reasonFor(disabled.scene, "a", "d"), "SRDF: disabled by default");
  EXPECT_EQ(reasonFor(disabled.scene, "c", "d"), "rigidly joined");
  const auto of_user =
      parseSrdf("<robot name='chain'><disable_collisions link1='d' link2='c' reason='Adjacent'/></robot>");
  EXPECT_EQ(reasonFor(describe(chain(), of_user).scene, "c", "d"), "SRDF: Adjacent") << "not watched";
  ASSERT_EQ(disabled.warnings.size(), 1u);
  EXPECT_NE(disabled.warnings[0].find("ghost"), std::string::npos);

  srdf.enabled = {{"a", "d"}, {"c", "a"}, {"c", "d"}};
  const SceneDescription enabled = describe(chain(), srdf).scene;
  EXPECT_EQ(reasonFor(enabled, "d", "a"), "checked");
  EXPECT_EQ(reasonFor(enabled, "a", "c"), "SRDF: Never");  // as in MoveIt, disabling wins
  EXPECT_EQ(reasonFor(enabled, "c", "d"), "rigidly joined");
}

TEST(DescribeRobot, AnSrdfOfAnotherRobotIsTold) {
  const Described described = describe(chain(), parseSrdf("<robot name='crane'/>"));
  ASSERT_EQ(described.warnings.size(), 1u);
  EXPECT_EQ(described.warnings[0].find("the SRDF is of robot crane, the URDF of robot chain"), 0u);
  EXPECT_TRUE(describe(chain(), parseSrdf("<robot name='chain'/>")).warnings.empty());
  EXPECT_TRUE(describe(chain(), parseSrdf("<robot/>")).warnings.empty());
}

TEST(DescribeRobot, AnSrdfsOwnWarningsAndUnknownLinksAreTold) {
  const Described described = describe(
      chain(), parseSrdf("<robot><virtual_joint name='world' type='fixed' parent_frame='map' child_link='torso'/>"
                         "<disable_collisions link1='${p}a' link2='b'/></robot>"));
  ASSERT_EQ(described.warnings.size(), 3u);
  EXPECT_EQ(described.warnings[0], "line 1 of the SRDF: xacro has not expanded it, and what it stands for is missing");
  EXPECT_EQ(described.warnings[1], "the SRDF names link ${p}a, which the URDF does not have");
  EXPECT_EQ(described.warnings[2], "the SRDF names link torso, which the URDF does not have");
}

TEST(DescribeRobot, SrdfMayNamePatterns) {
  Srdf srdf;
  srdf.disabled = {{"a", "?", "SRDF: Never"}, {"x*", "a", "SRDF: Never"}};
  const Described disabled = describe(chain(), srdf);
  EXPECT_EQ(reasonFor(disabled.scene, "a", "c"), "SRDF: Never");
  EXPECT_EQ(reasonFor(disabled.scene, "a", "d"), "SRDF: Never");
  ASSERT_EQ(disabled.warnings.size(), 1u);
  EXPECT_NE(disabled.warnings[0].find("link x*"), std::string::npos);

  srdf.disabled.clear();
  srdf.disabled_by_default = {"[c-d]", "c*"};
  EXPECT_EQ(reasonFor(describe(chain(), srdf).scene, "a", "c"), "SRDF: disabled by default");
  EXPECT_EQ(reasonFor(describe(chain(), srdf).scene, "a", "d"), "checked") << "there are no sets of characters";
  srdf.enabled = {{"?", "c"}};
  EXPECT_EQ(reasonFor(describe(chain(), srdf).scene, "a", "c"), "checked");
}

TEST(DescribeRobot, ThousandsOfLinksAreRefused) {
  std::string urdf = "<robot name='centipede'>";
  for (int i = 0; i < 1000; ++i) {
    const std::string name = "l" + std::to_string(i);
    urdf += "<link name='" + name + "'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>";
    if (i > 0)
      urdf += "<joint name='j" + name + "' type='continuous'><parent link='l0'/><child link='" + name +
              "'/><axis xyz='0 0 1'/></joint>";
  }
  const RobotModel robot(urdf + "</robot>");
  std::vector<std::string> warnings;
  const std::string why = test::failureOf<std::length_error>([&] { describeRobot(robot, {}, loadOwn, {}, warnings); });
  EXPECT_EQ(why,
            "robot centipede has 1000 links with collision elements, which are 499500 pairs; at most 300000 can be "
            "checked");
}

BodyDescription worldBox(const std::string& name, const std::string& frame, const Vector3d& place,
                         const Vector3d& half_size) {
  BodyDescription body;
  body.name = name;
  body.frame = frame;
  body.X_frame_B.translation() = place;
  body.is_world = true;
  body.geometry.resize(1);
  body.geometry[0].shape = Primitive(Box::fromSize(2.0 * half_size));
  return body;
}

/// A base that stands in the world, a chain of three links on it, the last two of which are rigidly joined.
TEST(DescribeRobot, WorldObjectsInTheRootsFrameAreRigidlyJoinedToIt) {
  const std::string cube = box("0.1 0.1 0.1");
  const RobotModel robot("<robot name='r'>" + link("world") + link("base", cube) + link("arm", cube) +
                         link("hand", cube) + joint("world", "base", "fixed", "0 0 1") +
                         joint("base", "arm", "continuous", "1 0 0") + joint("arm", "hand", "fixed", "0.5 0 0") +
                         "</robot>");
  std::vector<std::string> warnings;
  SceneDescription scene = describeRobot(robot, {}, loadOwn, {}, warnings);
  scene.bodies.push_back(worldBox("table", "world", {3, 0, 0}, Vector3d::Constant(0.1)));
  scene.bodies.push_back(worldBox("elsewhere", "map", {9, 0, 0}, Vector3d::Constant(0.5)));
  scene.bodies.push_back(worldBox("mark", "hand", {0.2, 0, 0}, Vector3d::Constant(0.1)));
  BodyDescription held = worldBox("held", "base", {0, 0, 1}, Vector3d::Constant(0.1));
  held.is_world = false;
  held.is_attached = true;
  scene.bodies.push_back(held);
  BodyDescription tile = worldBox("tile", "world", {0, 0, 1}, Vector3d::Constant(0.1));
  tile.map = "map";
  scene.bodies.push_back(tile);
  for (const std::string prefix : {"", "left/"}) {
    for (BodyDescription& body : scene.bodies) body.frame = prefix + body.frame;
    setRigidRoots(robot, scene, prefix);
    EXPECT_EQ(reasonFor(scene, "table", "base"), "rigidly joined");
    for (const char* moving : {"arm", "hand"}) {
      EXPECT_EQ(reasonFor(scene, "table", moving), "checked");
      EXPECT_EQ(reasonFor(scene, "elsewhere", moving), "checked");
    }
    EXPECT_EQ(reasonFor(scene, "elsewhere", "base"), "checked");
    EXPECT_EQ(reasonFor(scene, "mark", "hand"), "in the same frame");
    EXPECT_EQ(reasonFor(scene, "mark", "arm"), "checked");
    EXPECT_EQ(reasonFor(scene, "held", "base"), "rigidly joined");
    EXPECT_EQ(reasonFor(scene, "held", "table"), "checked") << "attached objects are checked against the world";
    EXPECT_EQ(reasonFor(scene, "held", "arm"), "checked");
    EXPECT_EQ(reasonFor(scene, "tile", "base"), "checked") << "what a map shows comes and goes";
  }
  for (const PairDecision& pair : planScene(scene).left_out) {
    if (pair.body_a != "base" || pair.body_b != "table") continue;
    ASSERT_TRUE(pair.rigid);
    EXPECT_TRUE(pair.rigid->X_AB.isApprox(Isometry3d(Eigen::Translation3d(3.0, 0.0, -1.0)), 1e-12));
    return;
  }
  FAIL() << "base and table";
}

}  // namespace sdf_ccd::robot_pairs_test
