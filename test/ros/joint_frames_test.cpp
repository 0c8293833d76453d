#include "ros/bag/joint_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "ros/tf/tf_pose.h"

namespace sdf_ccd::joint_frames_test {

std::string joint(const std::string& name, const std::string& type, const std::string& links,
                  const std::string& more = "") {
  const std::string parent = links.substr(0, 1), child = links.substr(1);
  return "<link name='" + child + "'/><joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/><origin xyz='0.1 0.2 0.3' rpy='0.3 0.2 0.1'/><axis xyz='0 0 1'/>" + more +
         "</joint>";
}

/// a - b - c - d with a continuous, a prismatic and a mimic joint; fixed e and floating f on a.
const std::string kUrdf = "<robot name='tree'><link name='a'/>" + joint("turn", "continuous", "ab") +
                          joint("slide", "prismatic", "bc", "<limit lower='-1' upper='1' effort='1' velocity='1'/>") +
                          joint("follow", "continuous", "cd", "<mimic joint='turn' multiplier='-2' offset='0.5'/>") +
                          joint("bolt", "fixed", "ae") + joint("fly", "floating", "af") + "</robot>";

sensor_msgs::JointState stateOf(const std::map<std::string, double>& positions) {
  sensor_msgs::JointState state;
  for (const auto& [name, position] : positions) {
    state.name.push_back(name);
    state.position.push_back(position);
  }
  return state;
}

std::string childrenOf(const tf2_msgs::TFMessage& message) {
  std::string children;
  for (const auto& transform : message.transforms) children += transform.child_frame_id + " ";
  return children;
}

TEST(JointFrames, ChainsAreTheForwardKinematics) {
  const auto robot = std::make_shared<const RobotModel>(kUrdf);
  const JointFrames frames(robot, "");
  const std::map<std::string, double> positions = {{"turn", 0.7}, {"slide", -0.4}};
  const tf2_msgs::TFMessage message = frames.moved(stateOf(positions), ros::Time(5.0));
  EXPECT_EQ(childrenOf(message), "b c d ");
  Isometry3d X_AD = Isometry3d::Identity();
  for (const auto& transform : message.transforms) {
    EXPECT_EQ(transform.header.stamp, ros::Time(5.0));
    X_AD = X_AD * toTfPose({}, transform.transform).isometry();
  }
  const std::vector<Isometry3d> X_AL = robot->forwardKinematics(positions);
  const auto d = std::find(robot->links().begin(), robot->links().end(), "d") - robot->links().begin();
  EXPECT_TRUE(X_AD.isApprox(X_AL[std::size_t(d)], 1e-12));
}

TEST(JointFrames, OnlyJointsThatHaveAPositionMove) {
  const JointFrames frames(std::make_shared<const RobotModel>(kUrdf), "left/");
  EXPECT_EQ(childrenOf(frames.moved(stateOf({{"slide", 0.1}, {"stranger", 1.0}, {"bolt", 1.0}}), ros::Time(1.0))),
            "left/c ");
  EXPECT_EQ(childrenOf(frames.moved(stateOf({{"turn", std::nan("")}}), ros::Time(1.0))), "");
  sensor_msgs::JointState cut = stateOf({{"slide", 0.1}, {"turn", 0.2}});
  cut.position.resize(1);
  EXPECT_EQ(childrenOf(frames.moved(cut, ros::Time(1.0))), "left/c ");
  EXPECT_TRUE(frames.knows("slide"));
  EXPECT_FALSE(frames.knows("stranger"));
}

TEST(JointFrames, AMimicJointIsWhereItIsSaidToBe) {
  const JointFrames frames(std::make_shared<const RobotModel>(kUrdf), "");
  const auto rotationOfLast = [&](const std::map<std::string, double>& positions) {
    const tf2_msgs::TFMessage message = frames.moved(stateOf(positions), ros::Time(1.0));
    EXPECT_EQ(message.transforms.back().child_frame_id, "d");
    return Matrix3d(toTfPose({}, message.transforms.back().transform).isometry().linear());
  };
  const Matrix3d at_zero = rotationOfLast({{"follow", 0.0}});
  const auto angle = [&](const std::map<std::string, double>& positions) {
    const Matrix3d turned = at_zero.transpose() * rotationOfLast(positions);
    return std::atan2(turned(1, 0), turned(0, 0));
  };
  EXPECT_NEAR(angle({{"turn", 0.7}, {"follow", 0.1}}), 0.1, 1e-12);
  EXPECT_NEAR(angle({{"follow", 0.1}}), 0.1, 1e-12);
  EXPECT_NEAR(angle({{"turn", 0.7}}), -0.9, 1e-12);
  EXPECT_EQ(childrenOf(frames.moved(stateOf({{"follow", 0.1}}), ros::Time(1.0))), "d ");
}

TEST(JointFrames, FixedLinksAreThoseThatAreWanted) {
  const JointFrames frames(std::make_shared<const RobotModel>(kUrdf), "");
  EXPECT_EQ(childrenOf(frames.fixed(ros::Time(1.0), [](const std::string&) { return true; })), "e ");
  EXPECT_EQ(childrenOf(frames.fixed(ros::Time(1.0), [](const std::string& link) { return link != "e"; })), "");
}

}  // namespace sdf_ccd::joint_frames_test
