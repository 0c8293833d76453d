// Markers for rviz: sizes, names and ids, colours by verdict, deletions, labels that do not overlap.

#include "ros/messages/markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/number_text.h"
#include "oracle/scene_case.h"
#include "ros/messages/link_markers.h"
#include "ros/messages/planned_markers.h"
#include "ros/messages/shape_marker.h"
#include "ros/messages/status_text.h"
#include "ros/messages/world_markers.h"

namespace sdf_ccd::markers_test {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

constexpr double kRadius = 0.1, kCycle = 0.1;  // [m], [s]

Isometry3d at(double x) {
  return Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

/// A row of balls; neighbours are checked as in the list of pairs.
class MarkersTest : public ::testing::Test {
 protected:
  MarkersTest() : MarkersTest(2) {}
  explicit MarkersTest(int count) {
    for (int i = 0; i < count; ++i)
      description_.bodies.push_back(test::body("ball" + std::to_string(i), Sphere{kRadius}));
    scene_ = test::build(description_);
    monitor_ = std::make_unique<Monitor>(scene_, test::soft());
  }

  /// Draws one cycle with the balls at rest at these x [m].
  MarkerArray draw(const std::vector<double>& x) {
    std::vector<std::vector<Isometry3d>> poses;
    for (const double place : x) poses.push_back(test::still(at(place)));
    motion_ = test::cycle(kCycle, poses);
    motion_.missing = missing_;
    result_ = monitor_->run(motion_, {false, 5});
    const CycleContext context{*scene_, motion_, motion_.times, start_};
    drawn_ = drawer_.draw(result_, context, start_ + ros::Duration(kCycle + 0.25), warnings_);
    start_ += ros::Duration(kCycle);
    return drawn_;
  }

  static std::vector<Marker> named(const MarkerArray& markers, const std::string& name, int action = Marker::ADD) {
    std::vector<Marker> found;
    for (const Marker& marker : markers.markers) {
      if (marker.ns == name && marker.action == action) found.push_back(marker);
    }
    return found;
  }

  static std::string status(const MarkerArray& markers) {
    const std::vector<Marker> found = named(markers, "status");
    return found.size() == 1 ? found[0].text : "";
  }

  SceneDescription description_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Monitor> monitor_;
  MarkerDrawer drawer_{"world", {1.0, 0.5}};
  ros::Time start_{100.0};
  CycleMotion motion_;
  CycleResult result_;
  std::vector<std::string> missing_;
  std::vector<std::string> warnings_;
  MarkerArray drawn_;  // last
};

class ManyMarkersTest : public MarkersTest {
 protected:
  ManyMarkersTest() : MarkersTest(6) {}
};

TEST_F(MarkersTest, StatusTellsVerdictClearanceBoundAndAge) {
  const MarkerArray markers = draw({0.0, 0.5});
  ASSERT_EQ(status(markers).find("CLEAR, at least "), 0u) << status(markers);
  const double clearance = 1e-3 * std::stod(status(markers).substr(16));
  EXPECT_LE(clearance, 0.3 + 1e-4);
  EXPECT_GT(clearance, 0.2);
  EXPECT_NE(status(markers).find("error bound " + lengthText(std::max(1e-6, result_.error_bound))), std::string::npos);
  EXPECT_NE(status(markers).find("0.25 s ago"), std::string::npos) << status(markers);
  EXPECT_EQ(markers.markers.size(), 1u);
}

TEST_F(MarkersTest, StatusTellsStandingWarnings) {
  warnings_ = {"the fixed frame moves", "2 pairs are set aside: a - b, c - d\nand how to make it permanent"};
  const std::string text = status(draw({0.0, 0.5}));
  EXPECT_EQ(text.find("CLEAR, at least "), 0u) << text;
  EXPECT_NE(text.find("\nWarning: the fixed frame moves"), std::string::npos) << text;
  EXPECT_NE(text.find("\nWarning: 2 pairs are set aside: a - b, c - d"), std::string::npos) << text;
  EXPECT_EQ(text.find("permanent"), std::string::npos) << "there is no room for it";
}

TEST_F(MarkersTest, ContactIsListedNumberedAndDeletedWhenItIsOld) {
  const MarkerArray touching = draw({0.0, 0.15});
  EXPECT_EQ(status(touching).find("CONTACT, "), 0u) << status(touching);
  EXPECT_NE(status(touching).find("1  ball0 - ball1: "), std::string::npos) << status(touching);
  for (const char* name : {"points", "normals", "depth", "swept", "numbers"}) {
    ASSERT_EQ(named(touching, name).size(), 1u) << name;
    EXPECT_EQ(named(touching, name)[0].id, 0) << name;
    EXPECT_EQ(named(touching, name)[0].header.stamp, ros::Time(0)) << name;
  }
  EXPECT_EQ(status(draw({0.0, 0.5})).find("CONTACT, "), 0u) << "it is held for half a second";
  for (int i = 0; i < 3; ++i) draw({0.0, 0.5});
  const MarkerArray old = draw({0.0, 0.5});
  for (const char* name : {"points", "normals", "depth", "swept", "numbers"}) {
    EXPECT_EQ(named(old, name, Marker::DELETE).size(), 1u) << name;
  }
  EXPECT_EQ(status(draw({0.0, 0.5})).find("CLEAR"), 0u);
}

TEST_F(MarkersTest, TheListSaysAsTheHeadlineHowDeepAHeldContactWas) {
  draw({0.0, 0.15});
  const std::string text = status(draw({0.0, 0.19}));
  const double deep = std::stod(text.substr(9)), listed = std::stod(text.substr(text.find("ball1: ") + 7));
  EXPECT_NEAR(deep, 50.0, 2.0) << text;  // [mm]
  EXPECT_EQ(listed, deep) << text;
}

TEST_F(MarkersTest, SizesFollowTheRobot) {
  const auto size = [&](double distance) { return named(draw({0.0, distance}), "status")[0].scale.z; };
  const double small = size(0.5), large = size(8.0);
  EXPECT_NEAR(small, std::hypot(0.7, 0.2, 0.2) / 26.0, 0.2 * small);
  EXPECT_NEAR(large, std::hypot(8.2, 0.2, 0.2) / 26.0, 0.2 * large);
}

TEST_F(MarkersTest, StatusIsAboveTheRobot) {
  const Marker text = named(draw({0.0, 0.15}), "status")[0];
  EXPECT_GT(text.pose.position.z - 0.5 * lineCount(text.text) * text.scale.z, kRadius);
}

TEST_F(MarkersTest, NothingCheckedDeletesAllAndSaysWhy) {
  draw({0.0, 0.15});
  const MarkerArray markers = drawer_.clear("no new transforms");
  ASSERT_EQ(markers.markers.size(), 2u);
  EXPECT_EQ(markers.markers[0].action, Marker::DELETEALL);
  EXPECT_EQ(status(markers), "NOT CHECKED\nno new transforms");
  EXPECT_EQ(drawer_.states().verdict(), Verdict::kNotChecked);
}

TEST_F(MarkersTest, LinksHaveTheColourOfTheirVerdict) {
  LinkMarkers links(description_);
  const auto colorOf = [&] {
    const bool has_changed = links.draw(drawer_.states().ofBodies(*scene_));
    return has_changed ? links.markers().markers.at(0).color : std_msgs::ColorRGBA();
  };
  const auto isColor = [](const std_msgs::ColorRGBA& color, Verdict verdict) {
    const std_msgs::ColorRGBA wanted = verdictColor(verdict, color.a);
    return color.a > 0.0F && color.a < 1.0F && color.r == wanted.r && color.g == wanted.g && color.b == wanted.b;
  };
  draw({0.0, 0.5});
  EXPECT_TRUE(isColor(colorOf(), Verdict::kClear));
  draw({0.0, 0.5});
  EXPECT_FALSE(links.draw(drawer_.states().ofBodies(*scene_))) << "nothing has changed";
  draw({0.0, 0.15});
  EXPECT_TRUE(isColor(colorOf(), Verdict::kContact));
  drawer_.clear("reset");
  EXPECT_TRUE(isColor(colorOf(), Verdict::kNotChecked));
  draw({0.0, 2.0 * kRadius});  // they touch, up to rounding
  EXPECT_TRUE(isColor(colorOf(), Verdict::kUncertain));
  EXPECT_EQ(status(drawn_).find("UNCERTAIN, within the error bound:\nball0 - ball1\n"), 0u) << status(drawn_);
  drawer_.clear("reset");
  missing_ = {"no transform", ""};
  const MarkerArray markers = draw({0.0, 0.5});
  EXPECT_TRUE(isColor(colorOf(), Verdict::kNotChecked));
  EXPECT_NE(status(markers).find("1 of 1 pairs not checked: ball0 - ball1: no transform"), std::string::npos)
      << status(markers);
}

TEST_F(MarkersTest, ADelayedPairKeepsItsVerdict) {
  draw({0.0, 0.5});
  CycleResult delayed = result_;
  delayed.pairs[0].span = {};
  delayed.pairs[0].verdict = Verdict::kNotChecked;
  PairStates states(0.5);
  const CycleContext context{*scene_, motion_, motion_.times, start_};
  states.update(result_, context);
  states.update(delayed, context);
  EXPECT_EQ(states.verdict(), Verdict::kClear);
  EXPECT_EQ(states.pairs()[0].until, start_ + ros::Duration(kCycle));
}

TEST_F(ManyMarkersTest, OnlyTheDeepestAreListedAndNumbersDoNotOverlap) {
  const MarkerArray markers = draw({0.0, 0.19, 0.37, 0.54, 0.70, 0.85});
  std::vector<Marker> numbers = named(markers, "numbers");
  ASSERT_EQ(numbers.size(), std::size_t(MarkerDrawer::kListed));
  EXPECT_NE(status(markers).find("1  ball4 - ball5: "), std::string::npos) << status(markers);
  EXPECT_NE(status(markers).find("and 1 more"), std::string::npos) << status(markers);
  std::sort(numbers.begin(), numbers.end(),
            [](const Marker& a, const Marker& b) { return a.pose.position.z < b.pose.position.z; });
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    EXPECT_GE(numbers[i].pose.position.z - numbers[i - 1].pose.position.z, numbers[i].scale.z);
  }
  std::set<std::pair<std::string, int>> names;
  for (const Marker& marker : markers.markers) EXPECT_TRUE(names.insert({marker.ns, marker.id}).second);
}

TEST(Staggered, LabelsAtOnePlaceAreOneAboveTheOther) {
  const std::vector<Vector3d> places = staggered({{0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, 0, 1.05}}, 0.1);
  EXPECT_EQ(places[2].z(), 0.0);
  EXPECT_EQ(places[0].z(), 1.0);
  EXPECT_NEAR(places[1].z(), 1.1, 1e-12);
  EXPECT_NEAR(places[3].z(), 1.2, 1e-12);
}

TEST(ShapeMarker, AMeshIsNamedIfRvizFindsItByItsName) {
  GeometryDescription mesh = test::body("link", test::meshShape(tessellate(Sphere{kRadius}, 0.01))).geometry[0];
  const std::size_t triangles = std::get<1>(mesh.shape)->triangles.size();
  const auto shape = [&](const std::string& source, const std::optional<Vector3d>& scale) {
    mesh.source = source;
    mesh.scale = scale;
    Marker marker;
    setShape(mesh, marker);
    return marker;
  };
  const Vector3d scale(1.0, -1.0, 1.0);
  EXPECT_EQ(shape("package://robot/link.stl", scale).type, Marker::MESH_RESOURCE);
  EXPECT_EQ(shape("package://robot/link.stl", scale).mesh_resource, "package://robot/link.stl");
  EXPECT_EQ(shape("package://robot/link.stl", scale).scale.y, -1.0);
  for (const Marker& told : {shape("link.stl", scale), shape("package:///robot/link.stl", scale),
                             shape("package://robot/link.stl", std::nullopt)}) {
    EXPECT_EQ(told.type, Marker::TRIANGLE_LIST);
    EXPECT_EQ(told.points.size(), 3 * triangles);
  }
}

TEST(WorldMarkers, AVoxelMapIsItsSurfaceVoxels) {
  // Two voxels of 0.5 m, one on top of the other, from (0.5, 0, 0) on.
  const double size = 0.5;
  TriangleMesh surface = transformed(tessellate(Box::fromSize(Vector3d::Constant(0.5)), 0.01), at(0.75));
  surface = transformed(std::move(surface), Isometry3d(Eigen::Translation3d(0.0, 0.25, 0.25)));
  TriangleMesh upper = transformed(surface, Isometry3d(Eigen::Translation3d(0.0, 0.0, size)));
  SceneDescription scene;
  scene.bodies.push_back(test::body("octomap", test::meshShape(merged(std::move(surface), upper)), true));
  scene.bodies[0].geometry[0].watertight_voxels = true;
  const MarkerArray markers = toWorldMarkers(scene);
  ASSERT_EQ(markers.markers.size(), 1u);
  const Marker& map = markers.markers[0];
  EXPECT_EQ(map.type, Marker::CUBE_LIST);
  EXPECT_NEAR(map.scale.x, size, 1e-12);
  ASSERT_EQ(map.points.size(), 2u);
  ASSERT_EQ(map.colors.size(), 2u);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(toEigen(map.points[i]).isApprox(Vector3d(0.75, 0.25, 0.25 + i * size), 1e-9));
  EXPECT_LT(map.colors[0].g, map.colors[1].g) << "low is dark";
  for (const auto& color : map.colors) EXPECT_TRUE(color.r == color.g && color.g == color.b) << "colours are verdicts";
}

TEST(WorldMarkers, APlaneIsDrawnWhereItIsChecked) {
  SceneDescription scene;
  scene.bodies.push_back(test::body("wall", Primitive(HalfSpace{Vector3d::UnitX(), 0.5}), true));
  scene.bodies[0].X_frame_B.translation() = Vector3d(0.0, 0.0, 1.0);
  const MarkerArray markers = toWorldMarkers(scene);
  ASSERT_EQ(markers.markers.size(), 1u);
  const Isometry3d X = toIsometry(markers.markers[0].pose);
  EXPECT_TRUE(X.translation().isApprox(Vector3d(0.5, 0.0, 1.0), 1e-12));
  EXPECT_TRUE((X.linear() * Vector3d::UnitZ()).isApprox(Vector3d::UnitX(), 1e-12));
}

TEST_F(MarkersTest, APlannedMotionIsDrawnWithItsFirstContact) {
  CycleMotion motion = test::cycle(2.0, {{at(0.0), at(0.25), at(0.5)}, test::still(at(0.5), 3)});
  const CycleResult result = monitor_->run(motion, {false, 5});
  PlannedMarkers planned(description_);
  planned.add(motion);
  const MarkerArray markers = planned.draw(result, {*scene_, motion, motion.times, ros::Time()}, "world");
  EXPECT_EQ(markers.markers[0].action, Marker::DELETEALL);
  EXPECT_EQ(named(markers, "ghosts").size(), std::size_t(PlannedMarkers::kGhosts + 1)) << "of the one that moves";
  ASSERT_EQ(named(markers, "paths").size(), 1u);
  EXPECT_NEAR(named(markers, "paths")[0].points.back().x, 0.5, 1e-9);
  ASSERT_EQ(named(markers, "first_contact").size(), 2u);
  EXPECT_NEAR(named(markers, "first_contact")[0].pose.position.x, 0.4, 0.02);  // left side of the ball at rest
  EXPECT_NE(named(markers, "first_contact")[1].text.find("ball0 - ball1"), std::string::npos);
  EXPECT_NEAR(std::stod(named(markers, "first_contact")[1].text.substr(29)), 1.2, 0.05);
}

TEST(StatusText, LinesAreWrapped) {
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("abcdefgh", 3), "abc\ndef\ngh");
  EXPECT_EQ(lineCount("a\nb"), 2);
}

}  // namespace sdf_ccd::markers_test
