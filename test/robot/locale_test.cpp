#include <gtest/gtest.h>

#include "oracle/german_locale.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::locale_test {

// The numbers of a URDF are read by urdfdom, whose own reader does not follow the locale.
TEST(RobotLocale, AUrdfIsTheSameInEveryLocale) {
  SDF_CCD_NEEDS_GERMAN_LOCALE();
  const test::GermanLocale german;
  const RobotModel robot(R"(<robot name="r"><link name="a"><collision><origin xyz="0.5 -1.25 1e-3" rpy="0 0 0.75"/>
      <geometry><sphere radius="0.125"/></geometry></collision></link><link name="b"/>
      <joint name="j" type="prismatic"><parent link="a"/><child link="b"/><origin xyz="1.5 0 0"/><axis xyz="0.6 0 0.8"/>
      <limit lower="-0.5" upper="0.25" effort="1" velocity="1.5"/></joint></robot>)");
  const urdf::Collision& shape = *robot.urdf().getLink("a")->collision;
  EXPECT_EQ(shape.origin.position.x, 0.5);
  EXPECT_EQ(shape.origin.position.y, -1.25);
  EXPECT_EQ(shape.origin.position.z, 1e-3);
  EXPECT_EQ(dynamic_cast<const urdf::Sphere&>(*shape.geometry).radius, 0.125);
  const urdf::Joint& joint = robot.jointAbove(robot.find("b"));
  EXPECT_EQ(joint.limits->lower, -0.5);
  EXPECT_EQ(joint.limits->velocity, 1.5);
  EXPECT_EQ(joint.axis.z, 0.8);
  EXPECT_TRUE(robot.forwardKinematics({{"j", 0.25}})[1].translation().isApprox(Vector3d(1.65, 0, 0.2)));
}

}  // namespace sdf_ccd::locale_test
