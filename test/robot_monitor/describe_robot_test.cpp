#include "sdf_ccd/robot.h"

#include <array>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "robot_monitor/describe_robot_case.h"

namespace sdf_ccd::describe_robot_test {

using namespace test;

TEST(DescribeRobot, LinksWithCollisionElementsAreBodies) {
  const Described described =
      describe("<robot name='r'>" +
               link("a", "<collision><geometry><sphere radius='0.2'/></geometry></collision>" + box("2 4 6", "1 2 3") +
                             "<collision><geometry><cylinder radius='0.1' length='3'/></geometry></collision>") +
               link("frame") + joint("a", "frame", "fixed", "0 0 0") + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), 1u);
  const BodyDescription& body = described.scene.bodies[0];
  EXPECT_EQ(body.name, "a");
  EXPECT_EQ(body.frame, "a");
  EXPECT_EQ(body.failure, "");
  EXPECT_FALSE(body.is_world);
  ASSERT_EQ(body.geometry.size(), 3u);
  EXPECT_EQ(std::get<Sphere>(std::get<Primitive>(body.geometry[0].shape)).radius, 0.2);
  EXPECT_EQ(std::get<Box>(std::get<Primitive>(body.geometry[1].shape)).size, Vector3d(2, 4, 6));
  EXPECT_EQ(body.geometry[1].X_BG.translation(), Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<Cylinder>(std::get<Primitive>(body.geometry[2].shape)).length, 3.0);
  EXPECT_EQ(body.geometry[2].source, "cylinder");
  EXPECT_TRUE(described.warnings.empty());
}

TEST(DescribeRobot, LinksThatAreOnlySeenAreNamed) {
  const std::string visual = "<visual><geometry><sphere radius='0.2'/></geometry></visual>";
  const Described described =
      describe("<robot name='r'>" + link("a", box("1 1 1", "0 0 0") + visual) + link("frame") +
               joint("a", "frame", "fixed", "0 0 0") + link("cover", visual) + joint("a", "cover", "fixed", "0 0 0") +
               link("lid", visual) + joint("a", "lid", "continuous", "0 0 0") + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), 1u);
  EXPECT_EQ(described.scene.visual_only, (std::vector<std::string>{"cover", "lid"}));
  ASSERT_EQ(described.warnings.size(), 1u);
  EXPECT_EQ(described.warnings[0],
            "2 links have a visual but no collision shape, so their contacts are not detected: cover lid");
}

TEST(DescribeRobot, MeshesAreSharedByUriAndScale) {
  const Described described = describe(
      "<robot name='r'>" +
      link("a", mesh("good.off") + mesh("good.off") + mesh("good.off", "1 -2 3") + mesh("good.off", "1 -2 3")) +
      "</robot>");
  using Mesh = std::shared_ptr<const TriangleMesh>;
  const auto& geometry = described.scene.bodies.at(0).geometry;
  ASSERT_EQ(geometry.size(), 4u);
  const auto meshOf = [&](int i) { return std::get<Mesh>(geometry[i].shape); };
  EXPECT_EQ(meshOf(0), meshOf(1));
  EXPECT_EQ(meshOf(2), meshOf(3));
  EXPECT_NE(meshOf(0), meshOf(2));
  // Mirrored about y: the vertices move, and the triangle's orientation is reversed with them.
  EXPECT_EQ(boundingBox(*meshOf(2)).min(), Vector3d(0, -4, 0));
  EXPECT_LT(areaNormal(*meshOf(0), 0).z() * -2.0, 0.0);
  EXPECT_NEAR(areaNormal(*meshOf(2), 0).z(), 2.0 * areaNormal(*meshOf(0), 0).z(), 1e-12);
  EXPECT_EQ(geometry[2].source, "good.off");
}

TEST(DescribeRobot, ElementsThatTheParserDropsCostTheirLinkAlone) {
  const std::string cube = box("0.1 0.1 0.1");
  const Described described =
      describe("<robot name='r'>" + link("good", cube) + link("short", cube + box("1 1")) +
               link("nan", box("1 1 1", "nan 0 0")) +
               link("capsule", "<collision><geometry><capsule radius='1'/></geometry></collision>") +
               link("empty", "<collision/>") + link("heavy", "<inertial><mass value='much'/></inertial>" + cube) +
               link("frame", "<visual><geometry><box size='1 1'/></geometry></visual>") +
               joint("good", "short", "floating", "0 0 0") + joint("good", "nan", "floating", "0 0 0") +
               joint("good", "capsule", "floating", "0 0 0") + joint("good", "empty", "floating", "0 0 0") +
               joint("good", "heavy", "floating", "0 0 0") + joint("good", "frame", "floating", "0 0 0") + "</robot>");
  std::map<std::string, std::string> failures;
  for (const BodyDescription& body : described.scene.bodies) failures[body.name] = body.failure;
  ASSERT_EQ(failures.size(), 6u);  // the frame has no collision element
  EXPECT_EQ(failures["good"], "");
  EXPECT_EQ(failures["short"].find("link short: line 1 of the URDF: 1 of 2 collision elements cannot be read: "), 0u)
      << failures["short"];
  EXPECT_NE(failures["nan"].find("nan"), std::string::npos);
  EXPECT_NE(failures["capsule"].find("capsule"), std::string::npos);
  EXPECT_NE(failures["empty"].find("1 of 1 collision elements"), std::string::npos);
  EXPECT_EQ(failures["heavy"], "") << "no shape depends on its mass";
}

/// Radius 0.1, 0.6 long between the centres, turned from z to x, about (1, 2, 3).
TEST(DescribeRobot, ACapsuleIsACylinderAndTwoSpheres) {
  const std::string shape = "<geometry><capsule radius='0.1' length='0.6'/></geometry>";
  const Described described = describe(
      "<robot name='r' version='1.2'>" +
      link("arm", "<visual>" + shape + "</visual>" + box("0.1 0.1 0.1") +
                      "<collision><origin xyz='1 2 3' rpy='0 1.5707963267948966 0'/>" + shape + "</collision>") +
      link("ball", "<collision><geometry><capsule radius='0.1' length='0'/></geometry></collision>") +
      link("turned", "<collision><geometry><capsule radius='0.1' length='-0.6'/></geometry></collision>") +
      joint("arm", "ball", "floating", "0 0 0") + joint("arm", "turned", "floating", "0 0 0") + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), 3u);
  const BodyDescription& arm = described.scene.bodies[0];
  EXPECT_EQ(arm.failure, "");
  EXPECT_TRUE(described.warnings.empty());
  ASSERT_EQ(arm.geometry.size(), 4u);
  // The truth: the distance to the segment between the centres, less the radius.
  const auto truth = [](const Vector3d& p) {
    const double x = std::max(0.7, std::min(1.3, p.x()));
    return (p - Vector3d(x, 2.0, 3.0)).norm() - 0.1;
  };
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(-0.6, 0.6);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = Vector3d(1.0, 2.0, 3.0) + Vector3d(side(random), side(random) / 3.0, side(random) / 3.0);
    double distance = HUGE_VAL;
    for (std::size_t g = 1; g < arm.geometry.size(); ++g) {
      const Vector3d p_G = arm.geometry[g].X_BG.inverse() * p;
      distance = std::min(distance, signedDistance(std::get<Primitive>(arm.geometry[g].shape), p_G));
    }
    EXPECT_EQ(distance < 0.0, truth(p) < 0.0);
    if (truth(p) > 0.0) {
      EXPECT_NEAR(distance, truth(p), 1e-12);
    } else {
      ++inside;
    }
  }
  EXPECT_GT(inside, 100);
  ASSERT_EQ(described.scene.bodies[1].geometry.size(), 1u);
  EXPECT_NE(described.scene.bodies[2].failure.find("1 of 1 collision elements cannot be read"), std::string::npos);
}

TEST(DescribeRobot, ElementsThatTheParserPassesOverCostTheirLinkAlone) {
  const std::string cube = box("0.1 0.1 0.1"), sphere = "<sphere radius='1'/>";
  const std::string visual =
      "<visual><geometry>" + sphere + sphere + "</geometry></visual><contact><lateral/></contact>";
  const std::vector<std::array<std::string, 3>> links = {
      // name, what is inside, the failure
      {"good",
       "<inertial><origin xyz='0 0 0'/><mass value='1'/>"
       "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>" +
           visual + "<!-- <Box/> -->" + cube,
       ""},
      {"origin", "<origin xyz='0 0 1'/>" + cube, ""},
      {"pose", "<pose>0 0 1 0 0 0</pose>" + cube, ""},
      {"extended",
       "<self_collision_checking><origin/><geometry><capsule/></geometry></self_collision_checking><sensor><contact>"
       "<collision>c</collision></contact></sensor><gazebo><collision><geometry/></collision></"
       "gazebo><extra><geometry><a/><b/></geometry></"
       "extra>" +
           cube,
       ""},
      {"painted", "<collision><geometry>" + sphere + "<material name='red'/></geometry></collision>", ""},
      {"capsule", "<collision><geometry>" + sphere + "<capsule/></geometry></collision>",
       "<capsule> in <geometry> is not read"},
      {"two", "<collision><geometry>" + sphere + "\n<cylinder radius='1' length='1'/></geometry></collision>",
       "line 3 of the URDF: <cylinder> in <geometry> is not read"},
      {"twice", "<collision><geometry>" + sphere + "</geometry><geometry>" + sphere + "</geometry></collision>",
       "<geometry> in <collision> is not read"},
      {"case", cube + "<Collision><geometry>" + sphere + "</geometry></Collision>",
       "<Collision> in <link> is not read"},
      {"moved", "<collision><Origin xyz='1 0 0'/><geometry>" + sphere + "</geometry></collision>",
       "<Origin> in <collision> is not read"},
      {"posed", "<collision><pose>1 0 0 0 0 0</pose><geometry>" + sphere + "</geometry></collision>",
       "<pose> in <collision> is not read"},
      {"rotated", "<collision><origin xyz='1 0 0' rotation='0 0 1.5'/><geometry>" + sphere + "</geometry></collision>",
       "<origin> in <collision> is not read in full"},
      {"shouted", "<collision><origin XYZ='1 0 0'/><geometry>" + sphere + "</geometry></collision>",
       "<origin> in <collision> is not read in full"},
      {"enlarged", "<collision><geometry><mesh filename='part.off' Scale='2 2 2'/></geometry></collision>",
       "<mesh> in <geometry> is not read in full"},
      {"annotated", "<collision><origin xyz='1 0 0' from='CAD 2'/><geometry>" + sphere + "</geometry></collision>", ""},
      {"unmoved",
       "<collision><pose>0 0 0 -0.0 0 0</pose><origin xyz='1 0 0' rotation='0 0 0'/><geometry>" + sphere +
           "</geometry></collision>",
       ""},
      {"bare", "<geometry>" + sphere + "</geometry>", "<geometry> in <link> is not read"},
      {"seen",
       "<visual><geometry>" + sphere + "</geometry><collision><geometry>" + sphere + "</geometry></collision></visual>",
       "<collision> in <visual> is not read"},
      {"listed", "<collisions><collision><geometry>" + sphere + "</geometry></collision></collisions>",
       "<collision> in <collisions> is not read"},
      {"direct", "<collision>" + sphere + "<geometry>" + sphere + "</geometry></collision>",
       "<sphere> in <collision> is not read"}};
  std::string urdf = "<robot name='r'>\n";
  for (const auto& [name, inside, failure] : links) {
    urdf += link(name, inside);
    if (name != "good") urdf += joint("good", name, "floating", "0 0 0");
  }
  const Described described = describe(urdf + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), links.size());
  std::map<std::string, std::string> failures;
  for (const BodyDescription& body : described.scene.bodies) failures[body.name] = body.failure;
  for (const auto& [name, inside, failure] : links) {
    EXPECT_EQ(failures[name].empty(), failure.empty()) << name;
    EXPECT_TRUE(failures[name].find(failure) != std::string::npos) << name << ": " << failures[name];
  }
  EXPECT_TRUE(described.warnings.empty()) << described.warnings.front();
}

TEST(DescribeRobot, AVisualWithoutAShapeCostsNoCollisionShape) {
  const std::string cube = box("0.1 0.1 0.1");
  const Described described = describe(
      "<robot name='r'>" + link("empty", "<visual/>" + cube) +
      link("bare", cube + "<visual><origin xyz='0 0 1'/><geometry/></visual>") +
      link("coloured", "<visual name='v'><material name='red'/></visual>" + cube) + link("alone", "<visual/>") +
      link("short", "<visual/>" + box("1 1")) + link("hidden", "<visual>" + cube + "</visual>") +
      joint("empty", "hidden", "floating", "0 0 0") + joint("empty", "bare", "floating", "0 0 0") +
      joint("empty", "coloured", "floating", "0 0 0") + joint("empty", "alone", "floating", "0 0 0") +
      joint("empty", "short", "floating", "0 0 0") + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), 5u);
  for (const BodyDescription& body : described.scene.bodies) {
    if (body.name == "hidden") {
      EXPECT_NE(body.failure.find("<collision> in <visual> is not read"), std::string::npos) << body.failure;
    } else if (body.name == "short") {
      EXPECT_NE(body.failure.find("1 of 1 collision elements cannot be read: "), std::string::npos) << body.failure;
      EXPECT_EQ(body.failure.find("visual"), std::string::npos) << body.failure;
    } else {
      EXPECT_EQ(body.failure, "") << body.name;
      EXPECT_EQ(body.geometry.size(), 1u) << body.name;
    }
  }
  EXPECT_TRUE(described.scene.visual_only.empty());
}

TEST(DescribeRobot, LinksWhoseNamesAreNotTextLoseNoElementUnnoticed) {
  const Described described =
      describe("<robot name='r'>" + link("base", box("1 1 1")) + link("bras_\xe9", box("0.1 0.1 0.1") + box("1 1")) +
               joint("base", "bras_\xe9", "floating", "0 0 0") + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), 2u);
  EXPECT_NE(described.scene.bodies[1].failure.find("1 of 2 collision elements cannot be read"), std::string::npos);
}

TEST(DescribeRobot, BadMeshCostsItsLinkAlone) {
  const Described described = describe(
      "<robot name='r'>" + link("good", mesh("good.off")) + link("forearm", mesh("good.off") + mesh("missing.stl")) +
      link("hand", mesh("garbage.off")) + link("thumb", mesh("missing.stl")) + link("flat", mesh("good.off", "1 0 1")) +
      link("sunk", box("1 -1 1")) + joint("good", "forearm", "continuous", "0 0 0") +
      joint("forearm", "hand", "continuous", "0 0 0") + joint("hand", "thumb", "continuous", "0 0 0") +
      joint("thumb", "flat", "continuous", "0 0 0") + joint("flat", "sunk", "continuous", "0 0 0") + "</robot>");
  ASSERT_EQ(described.scene.bodies.size(), 6u);
  EXPECT_EQ(described.scene.bodies[0].failure, "");
  EXPECT_EQ(described.scene.bodies[1].failure, "link forearm: missing.stl: no such file");
  EXPECT_TRUE(described.scene.bodies[1].geometry.empty());
  EXPECT_EQ(described.scene.bodies[2].failure.find("link hand: "), 0u);
  EXPECT_NE(described.scene.bodies[2].failure.find("garbage.off"), std::string::npos);
  EXPECT_EQ(described.scene.bodies[3].failure, "link thumb: missing.stl: no such file");
  EXPECT_EQ(described.scene.bodies[4].failure.find("link flat: good.off: "), 0u);
  EXPECT_EQ(described.scene.bodies[5].failure.find("link sunk: "), 0u);
  EXPECT_EQ(reasonFor(described.scene, "good", "hand"), "checked");  // the plan makes it NOT_CHECKED
}

TEST(DescribeRobot, WarningsArePassedOnOnce) {
  const Described described =
      describe("<robot name='r'>" + link("a", mesh("Good.OFF") + mesh("Good.OFF", "2 2 2")) + "</robot>");
  ASSERT_EQ(described.warnings.size(), 1u);
  EXPECT_NE(described.warnings[0].find("found good.off"), std::string::npos);
}

}  // namespace sdf_ccd::describe_robot_test
