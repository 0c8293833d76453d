#include "ros/monitor/objects_in_map.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"
#include "ros/tf/seconds_between.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::objects_in_map_test {

using test::stampedTransform;

/// A hand that moves by 1 m/s along x, and objects of the world in several frames.
class ObjectsInMapTest : public ::testing::Test {
 protected:
  ObjectsInMapTest() {
    for (std::size_t b = 1; b < description_.bodies.size(); ++b) {
      description_.bodies[b].frame = kFrames[b - 1];
      description_.bodies[b].is_world = true;
    }
    const auto send = [&](double t) {
      history_.add(test::message({stampedTransform("map", "world", t, 0.0), stampedTransform("world", "hand", t, t),
                                  stampedTransform("hand", "tool", t, 0.5), stampedTransform("tool", "marker", t, 0.1),
                                  stampedTransform("world", "belt", t, 0.1 * t)}),
                   false);
    };
    for (int t = 100; t <= 105; ++t) send(t);
    for (std::size_t b = 0; b < description_.bodies.size(); ++b) description_.bodies[b].name = kNames[b];
  }

  std::map<std::string, ObjectMask> masks(const CheckedWorld& world, const std::string& frame, double stamp,
                                          bool is_new = false) {
    std::map<std::string, ObjectMask> by_name;
    for (const ObjectMask& mask :
         ObjectsInMap(history_, world, frame).masks(ros::Time(stamp), [&](const auto&, auto) { return is_new; }))
      by_name.emplace(mask.name, mask);
    return by_name;
  }
  static bool isAt(const ObjectMask& mask, double x) {
    return mask.isWithin && mask.isWithin(Vector3d(x, 0, 0), 0.01) && !mask.isWithin(Vector3d(x + 0.15, 0, 0), 0.01);
  }

  static constexpr const char* kFrames[5] = {"world", "map", "tool", "marker", "belt"};
  static constexpr const char* kNames[6] = {"hand", "of world", "of map", "of tool", "of marker", "of belt"};
  SceneDescription description_{std::vector<BodyDescription>(6, test::body("hand", Sphere{0.1})), {}};
  TfHistory history_{"world"};
};

/// Also in a frame below the robot's, which no link has: as an object moves there, the robot pushes it into the map.
TEST_F(ObjectsInMapTest, WhatIsBelowAFrameOfTheRobotMovesWithIt) {
  const auto robot = firstWorld(test::build(description_), description_);
  for (const std::string frame : {"world", "map"}) {
    const auto found = masks(*robot, frame, 102.5);
    ASSERT_EQ(found.size(), 5u);
    for (const auto& [name, mask] : found)
      EXPECT_EQ(mask.is_attached, name == "of tool" || name == "of marker") << name << " in " << frame;
    EXPECT_TRUE(isAt(found.at("of tool"), 103.0));
    EXPECT_TRUE(isAt(found.at("of belt"), 10.25));
  }
  // Of a map that the robot carries, too; what is at rest in it does not move there.
  const auto carried = masks(*robot, "tool", 102.5);
  EXPECT_FALSE(carried.at("of tool").is_attached);
  EXPECT_FALSE(carried.at("of world").is_attached);
}

TEST_F(ObjectsInMapTest, WhatIsGraspedIsWhereItWasAndStillIs) {
  description_.bodies[1].is_world = false;
  description_.bodies[1].frame = "hand";
  const auto built = firstWorld(test::build(description_), description_);
  const auto grasped = [&](double time) {
    ChangingObject object;
    object.link = "arm";
    object.attached_since = sinceEpoch(ros::Time(time));
    return masks(CheckedWorld(built->snapshot, {{"of world", object}}), "world", 0.0, true).at("of world");
  };
  EXPECT_TRUE(isAt(grasped(105.0), 105.0));
  EXPECT_TRUE(grasped(104.9).isWithin(Vector3d(104.95, 0, 0), 0.01));
  EXPECT_FALSE(grasped(104.9).isWithin(Vector3d(104.82, 0, 0), 0.01)) << "it has left";
  EXPECT_FALSE(grasped(102.0).isWithin(Vector3d(102.0, 0, 0), 0.01)) << "something else may be there by now";
  EXPECT_FALSE(grasped(106.0).isWithin) << "tf does not know yet where it was";
}

}  // namespace sdf_ccd::objects_in_map_test
