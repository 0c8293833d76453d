#include "sdf_ccd/robot_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "motion/motion_sampling.h"
#include "oracle/files.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"
#include "robot_monitor/robot_scene_case.h"
#include "scene/body_options.h"
#include "scene/error_budget.h"

namespace sdf_ccd::robot_scene_test {

using namespace test;

TEST(RobotScene, FindsTheContactByNameTimeAndDepth) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  EXPECT_TRUE(scene.warnings().empty());
  EXPECT_EQ(scene.pairs(), (Names{{"base", "fore"}, {"base", "post"}, {"upper", "post"}, {"fore", "post"}}));

  MotionCheckOptions options;
  options.max_points = 3;
  const MotionResult result = scene.check(swing(0.0, 1.5, 10.0, 12.0), options);
  EXPECT_EQ(result.verdict, Verdict::kContact);
  EXPECT_GT(result.error_bound, 0.0);
  EXPECT_LT(result.error_bound, 2e-3);
  EXPECT_TRUE(result.assumed.empty());
  EXPECT_TRUE(result.notes.empty());
  ASSERT_EQ(result.pairs.size(), 4U);
  const MotionPair& hit = result.pairs.front();
  EXPECT_EQ(hit.body_a, "fore");
  EXPECT_EQ(hit.body_b, "post");
  EXPECT_EQ(hit.verdict, Verdict::kContact);
  const double enter = 10.0 + (kPostAngle - kTouchAngle) / 0.75, exit = 10.0 + (kPostAngle + kTouchAngle) / 0.75;
  ASSERT_EQ(hit.contacts.size(), 1U);
  EXPECT_NEAR(hit.contacts[0].enter, enter, 0.01);
  EXPECT_NEAR(hit.contacts[0].exit, exit, 0.01);
  ASSERT_TRUE(hit.first_contact);
  EXPECT_LE(hit.first_contact->enter, enter + 1e-9);
  EXPECT_GE(hit.first_contact->exit, enter - 1e-9);
  EXPECT_LT(hit.first_contact->exit - hit.first_contact->enter, 5e-3);
  EXPECT_NEAR(hit.deepest.depth, kRadius, hit.deepest.depth_error + 1e-9);  // when a side passes the ball's centre
  EXPECT_LT(hit.deepest.depth_error, 1e-3);
  EXPECT_GE(hit.deepest.time, enter - 0.01);
  EXPECT_LE(hit.deepest.time, exit + 0.01);
  EXPECT_LE((hit.deepest.p_W - kPost.X_frame_B.translation()).norm(), kRadius + 1e-3);
  ASSERT_FALSE(hit.points.empty());
  EXPECT_LE(hit.points.size(), 3U);
  EXPECT_GE(hit.points[0].enter, enter - 0.01);
  EXPECT_LE(hit.points[0].exit, exit + 0.01);
  EXPECT_TRUE(hit.on_b_W.force.allFinite());
  EXPECT_EQ(result.find("post", "fore"), &hit);
  EXPECT_EQ(result.find("post", "upper")->verdict, Verdict::kClear);
  EXPECT_EQ(result.find("base", "upper"), nullptr);  // adjacent

  EXPECT_EQ(scene.check(swing(0.0, kPostAngle - kTouchAngle - 0.001)).verdict, Verdict::kClear);
  EXPECT_EQ(scene.check(swing(0.0, kPostAngle - kTouchAngle + 0.001)).verdict, Verdict::kContact);
  options = {};
  options.margin = 0.1;
  EXPECT_EQ(scene.check(swing(0.0, kPostAngle - 0.2), options).verdict, Verdict::kUncertain);  // 0.09 m apart
  options = {};
  options.contacts = false;
  EXPECT_EQ(scene.check(swing(0.0, 1.5), options).verdict, Verdict::kContact);
}

TEST(RobotScene, MeasuresTheSmallestDistance) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  for (const double apart : {0.1, 0.2, 0.4}) {
    const double angle = kPostAngle - apart;
    const BodyDistance nearest = scene.distance({{"shoulder", angle}, {"elbow", 0.0}});
    const double truth = kPostAt * std::sin(apart) - kHalfWidth - kRadius;
    EXPECT_EQ(nearest.body_a, "fore");
    EXPECT_EQ(nearest.body_b, "post");
    EXPECT_EQ(nearest.verdict, Verdict::kClear);
    EXPECT_EQ(nearest.reason, "");
    EXPECT_NEAR(nearest.distance, truth, nearest.error + 1e-12);
    EXPECT_LT(nearest.error, 1e-3);
    const Vector3d across(std::cos(angle), 0.0, -std::sin(angle));
    EXPECT_LT((nearest.normal - across).norm(), 0.05);
    EXPECT_LT((nearest.point_a - along(angle, kPostAt * std::cos(apart)) - kHalfWidth * across).norm(), 5e-3);
    EXPECT_LT((nearest.point_b - kPost.X_frame_B.translation() + kRadius * across).norm(), 5e-3);
    EXPECT_EQ(nearest.depth, 0.0);
  }
  const BodyDistance inside = scene.distance({{"shoulder", kPostAngle}, {"elbow", 0.0}});
  EXPECT_EQ(inside.body_b, "post");
  EXPECT_EQ(inside.verdict, Verdict::kContact);
  EXPECT_EQ(inside.distance, 0.0);
  EXPECT_NEAR(inside.depth, kHalfWidth, inside.depth_error + 1e-9);
  EXPECT_LT(inside.depth_error, 1e-3);
}

TEST(RobotScene, ListsDistancesWithinARange) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  const double angle = kPostAngle - 0.4;
  const JointPositions joints = {{"shoulder", angle}, {"elbow", 0.0}};
  // In the arm's plane: the end of the upper link, the corner of the fore link that is nearest to the base's edge.
  const double to_upper = std::hypot(kPostAt * std::cos(0.4) - 0.45, kPostAt * std::sin(0.4) - 0.025) - kRadius;
  const Vector3d corner = along(angle, 0.52) + kHalfWidth * Vector3d(std::cos(angle), 0.0, -std::sin(angle)),
                 edge(0.1, 0.0, 0.05);
  const std::vector<double> truth = {kPostAt * std::sin(0.4) - kHalfWidth - kRadius, to_upper, (corner - edge).norm(),
                                     (kPost.X_frame_B.translation() - edge).norm() - kRadius};
  const Names names = {{"fore", "post"}, {"upper", "post"}, {"base", "fore"}, {"base", "post"}};
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [range, count] : {std::pair(0.2, 0U), {0.25, 1U}, {0.3, 2U}, {0.5, 3U}, {1.0, 4U}, {infinite, 4U}}) {
    const std::vector<BodyDistance> near = scene.distances(joints, range);
    ASSERT_EQ(near.size(), count) << range;
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(std::pair(near[i].body_a, near[i].body_b), names[i]);
      EXPECT_NEAR(near[i].distance, truth[i], near[i].error + 1e-12);
      EXPECT_LT(near[i].error, 2e-3);
    }
  }
  EXPECT_THROW(scene.distances(joints, -1.0), std::invalid_argument);
  EXPECT_THROW(scene.distances(joints, std::nan("")), std::invalid_argument);
}

TEST(RobotScene, JointsThatAreNotNamedAreWhereTheyAreSaidToBe) {
  RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  RobotTrajectory shoulder = swing(0.0, 1.5);
  for (RobotState& state : shoulder.states) state.positions.erase("elbow");
  const MotionResult unknown = scene.check(shoulder);
  EXPECT_EQ(unknown.verdict, Verdict::kNotChecked);
  EXPECT_NE(unknown.find("fore", "post")->reason.find("elbow"), std::string::npos);
  EXPECT_NE(unknown.find("fore", "post")->reason.find("setJoints"), std::string::npos);
  EXPECT_EQ(unknown.find("upper", "post")->verdict, Verdict::kClear);
  BodyDistance nearest = scene.distance({{"shoulder", kPostAngle - 0.4}});
  EXPECT_EQ(nearest.body_a, "upper");
  EXPECT_EQ(nearest.verdict, Verdict::kNotChecked);
  EXPECT_NE(nearest.reason.find("elbow"), std::string::npos) << nearest.reason;
  const std::vector<BodyDistance> near = scene.distances({{"shoulder", kPostAngle - 0.4}}, 0.3);
  ASSERT_EQ(near.size(), 3U);  // two that are not known, and upper - post
  EXPECT_EQ(near[0].verdict, Verdict::kNotChecked);
  EXPECT_TRUE(std::isnan(near[0].distance));
  EXPECT_EQ(near[2].body_a, "upper");

  scene.setJoints({{"elbow", 0.0}});
  const MotionResult known = scene.check(shoulder);
  EXPECT_EQ(known.verdict, Verdict::kContact);
  ASSERT_EQ(known.assumed.size(), 1U);
  EXPECT_EQ(known.assumed[0].name, "elbow");
  EXPECT_NEAR(known.assumed[0].position, 0.0, 1e-12);
  EXPECT_TRUE(hasLine(known.notes, "elbow"));
  scene.setJoints({{"elbow", -2.0}});  // folded: the ball is not reached
  EXPECT_EQ(scene.check(shoulder).find("fore", "post")->verdict, Verdict::kClear);
  EXPECT_THROW(scene.setJoints({{"wrist", 0.0}}), std::invalid_argument);
  EXPECT_THROW(scene.setJoints({{"elbow", std::nan("")}}), std::invalid_argument);
  EXPECT_NEAR(scene.check(shoulder).assumed.at(0).position, -2.0, 1e-12);
  nearest = scene.distance({{"shoulder", 3.5}});  // beyond its limit
  EXPECT_NE(nearest.verdict, Verdict::kNotChecked);
}

TEST(RobotScene, ChecksManyMotions) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  std::vector<RobotTrajectory> motions;
  for (int i = 0; i < 40; ++i) motions.push_back(swing(-1.0 + 0.05 * i, -0.8 + 0.05 * i, double(i), i + 1.0));
  const std::vector<MotionSummary> found = scene.checkMotions(motions);
  ASSERT_EQ(found.size(), motions.size());
  int contacts = 0;
  for (int i = 0; i < 40; ++i) {
    const double from = -1.0 + 0.05 * i, low = kPostAngle - kTouchAngle, high = kPostAngle + kTouchAngle;
    const bool touches = from < high && from + 0.2 > low;
    if (std::abs(from - high) < 1e-3 || std::abs(from + 0.2 - low) < 1e-3) continue;
    const MotionSummary& summary = found[static_cast<std::size_t>(i)];
    EXPECT_EQ(summary.verdict, touches ? Verdict::kContact : Verdict::kClear) << i;
    EXPECT_EQ(summary.verdict, scene.check(motions[static_cast<std::size_t>(i)]).verdict) << i;
    EXPECT_EQ(summary.body_a, touches ? "fore" : "");
    EXPECT_EQ(summary.body_b, touches ? "post" : "");
    if (touches) {
      const double angle = from + 0.2 * (summary.time - i);
      EXPECT_GE(angle, low - 1e-3) << i;
      EXPECT_LE(angle, high + 1e-3) << i;
    } else {
      EXPECT_TRUE(std::isnan(summary.time));
    }
    contacts += touches;
  }
  EXPECT_GT(contacts, 3);
  motions[7].states[1].positions["wrist"] = 0.0;
  const std::string message = messageOf<std::invalid_argument>([&] { scene.checkMotions(motions); });
  EXPECT_EQ(message.rfind("motion 7: ", 0), 0U) << message;
  EXPECT_NE(message.find("wrist"), std::string::npos) << message;
  EXPECT_TRUE(scene.checkMotions({}).empty());
}

TEST(RobotScene, BadMotionsAreRefused) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  const auto expectRefused = [&](const RobotTrajectory& trajectory, const std::string& part) {
    const std::string message = messageOf<std::invalid_argument>([&] { scene.check(trajectory); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  RobotTrajectory bad = swing(0.0, 1.0);
  bad.states[0].positions["wrist"] = bad.states[1].positions["wrist"] = 0.0;
  expectRefused(bad, "wrist");
  bad = swing(0.0, 1.0);
  bad.states.pop_back();
  expectRefused(bad, "2 times and 1 state");
  bad.times.pop_back();
  expectRefused(bad, "1 waypoint");
  expectRefused({}, "0 waypoints");
  bad = swing(0.0, 1.0);
  bad.states[1].positions.erase("elbow");
  expectRefused(bad, "");
  EXPECT_THROW(scene.check(bad), std::invalid_argument);
  expectRefused(swing(0.0, 3.1), "limits");
  EXPECT_THROW(scene.check(swing(0.0, 1.0, 2.0, 1.0)), std::invalid_argument);
  EXPECT_THROW(scene.check(swing(0.0, std::nan(""))), std::invalid_argument);
  EXPECT_THROW(scene.distance({{"wrist", 0.0}}), std::invalid_argument);
  MotionCheckOptions options;
  options.allow_beyond_limits = true;
  EXPECT_EQ(scene.check(swing(0.0, 3.1), options).verdict, Verdict::kContact);
  options.margin = -1.0;
  EXPECT_THROW(scene.check(swing(0.0, 1.0), options), std::invalid_argument);
  RobotSceneOptions wrong;
  wrong.max_error = 1.0;
  EXPECT_THROW(RobotScene::parse(kArm, {}, {}, wrong), std::invalid_argument);
}

class RobotSceneFiles : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    test::writeText(folder_ / name, text);
    return (folder_ / name).string();
  }

  /// The arm with a mesh for the upper link.
  std::string armWith(const std::string& uri) const {
    return kBase + "<link name='upper'><collision><origin xyz='0 0 0.25'/><geometry><mesh filename='" + uri +
           "'/></geometry></collision></link>" + kFore + kJoints;
  }

  const test::TemporaryDirectory folder_;
  static constexpr const char* kBar =
      "OFF\n8 12 0\n"
      "-.025 -.025 -.2\n.025 -.025 -.2\n.025 .025 -.2\n-.025 .025 -.2\n"
      "-.025 -.025 .2\n.025 -.025 .2\n.025 .025 .2\n-.025 .025 .2\n"
      "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n"
      "3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
};

TEST_F(RobotSceneFiles, MeshesAreBesideTheUrdfAndPairsInTheSrdf) {
  std::filesystem::create_directory(folder_ / "meshes");
  write("meshes/bar.off", kBar);
  const std::string urdf = write("arm.urdf", armWith("meshes/bar.off"));
  const std::string srdf = write("arm.srdf", R"(<robot name="arm">
    <disable_collisions link1="base" link2="fore" reason="Never"/></robot>)");
  WorldObject bar = kPost;
  bar.name = "bar";
  bar.shapes = {WorldShape{MeshObject{"meshes/bar.off", Vector3d::Ones()}, Isometry3d::Identity()}};
  const RobotScene scene = RobotScene::load(urdf, srdf, {kPost, bar});
  EXPECT_TRUE(scene.warnings().empty());
  EXPECT_EQ(scene.robot().root(), "base");
  EXPECT_EQ(
      scene.pairs(),
      (Names{
          {"base", "post"}, {"base", "bar"}, {"upper", "post"}, {"upper", "bar"}, {"fore", "post"}, {"fore", "bar"}}));
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).find("fore", "bar")->verdict, Verdict::kContact);
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).find("upper", "post")->verdict, Verdict::kClear);
  EXPECT_NE(scene.planText().find("SRDF: Never: base - fore"), std::string::npos) << scene.planText();
  EXPECT_EQ(RobotScene::load(urdf).pairs().size(), 1U);

  RobotSceneOptions options;
  options.checked_pairs = {{"base", "fore"}};
  options.allowed_pairs = {{"*", "post"}};
  EXPECT_EQ(RobotScene::load(urdf, srdf, {kPost}, options).pairs(), (Names{{"base", "fore"}}));
  options = {};
  options.loader = [](const std::string& uri) { return Resource{kBar, uri, ""}; };
  EXPECT_TRUE(RobotScene::parse(armWith("x://bar.off"), {}, {}, options).warnings().empty());
}

TEST_F(RobotSceneFiles, ABadMeshCostsItsLinkAlone) {
  const RobotScene scene = RobotScene::load(write("arm.urdf", armWith("none.off")), {}, {kPost});
  EXPECT_TRUE(hasLine(scene.warnings(), "not checked: link upper: none.off: no such file"));
  const MotionResult clear = scene.check(swing(0.0, 0.1));
  EXPECT_EQ(clear.verdict, Verdict::kNotChecked);
  EXPECT_NE(clear.find("upper", "post")->reason.find("none.off"), std::string::npos);
  EXPECT_EQ(clear.find("fore", "post")->verdict, Verdict::kClear);
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).verdict, Verdict::kContact);
  const std::vector<BodyDistance> near = scene.distances({{"shoulder", 0.0}, {"elbow", 0.0}}, 0.01);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_EQ(near[0].body_a, "upper");
  EXPECT_NE(near[0].reason.find("none.off"), std::string::npos);
}

TEST_F(RobotSceneFiles, FilesThatCannotBeReadAreNamed) {
  const std::string urdf = write("arm.urdf", kArm), none = (folder_ / "none").string();
  const auto expectNamed = [](const std::string& urdf_file, const std::string& srdf_file, const std::string& name) {
    const std::string message = messageOf<std::runtime_error>([&] { RobotScene::load(urdf_file, srdf_file); });
    EXPECT_NE(message.find(name), std::string::npos) << message;
  };
  expectNamed(none, {}, none);
  expectNamed(urdf, none, none);
  expectNamed(folder_.string(), {}, folder_.string());
  expectNamed(write("empty.urdf", ""), {}, "empty.urdf");
  expectNamed(write("bad.urdf", "<robot"), {}, "bad.urdf");
  expectNamed(urdf, write("bad.srdf", "<robot name='arm'>"), "bad.srdf");
  EXPECT_THROW(RobotScene::parse(""), std::runtime_error);
  EXPECT_THROW(RobotScene::parse(kArm, "nothing"), std::runtime_error);
}

TEST(RobotScene, LinksThatOverlapAtRestAreSetAsideUnlessTheyAreWanted) {
  std::string folded = kArm;  // the fore link reaches down to the base
  folded.replace(folded.find("<origin xyz=\"0 0 0.2\"/>"), 23, "<origin xyz=\"0 0 -0.5\"/>");
  const RobotScene usual = RobotScene::parse(folded, {}, {kPost});
  EXPECT_TRUE(hasLine(usual.warnings(), "base - fore"));
  EXPECT_EQ(usual.check(swing(0.0, 0.1)).find("base", "fore"), nullptr);
  RobotScene changed = RobotScene::parse(folded);
  changed.addObject(kPost);
  EXPECT_EQ(changed.check(swing(0.0, 0.1)).find("base", "fore"), nullptr);
  EXPECT_TRUE(hasLine(changed.warnings(), "base - fore"));
  RobotSceneOptions options;
  options.check_overlapping_pairs = true;
  const RobotScene all = RobotScene::parse(folded, {}, {}, options);
  EXPECT_EQ(all.check(swing(0.0, 0.1)).find("base", "fore")->verdict, Verdict::kContact);
}

TEST(RobotScene, IsTheLongForm) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  const MotionResult result = scene.check(swing(0.0, 1.5));

  const RobotModel robot(kArm);
  std::vector<std::string> warnings;
  SceneDescription description = describeRobot(robot, {}, {}, {}, warnings);
  BodyDescription post;
  post.name = "post";
  post.X_frame_B = kPost.X_frame_B;
  post.geometry.push_back({Primitive(Sphere{kRadius}), Isometry3d::Identity(), "sphere"});
  post.is_world = true;
  description.bodies.push_back(post);
  const MonitorOptions monitor;
  BodyOptions options = optionsForContacts();
  const double sampled = samplingTolerance(monitor.max_error, monitor.chords.tolerance);
  setMotionErrors(sampled, monitor.chords.tolerance, options);
  const auto built =
      std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(options)), options));
  MotionSampling sampling;
  sampling.tolerance = sampled;
  CycleRequest request;
  const CycleResult longer = checkMotion(
      built, monitor, planAlong(robot, completePlan(robot, swing(0.0, 1.5), {}, {}), bodiesOf(*built, robot), sampling),
      request);

  EXPECT_EQ(result.verdict, longer.verdict);
  EXPECT_EQ(result.error_bound, longer.error_bound);
  ASSERT_EQ(result.pairs.size(), longer.pairs.size());
  for (const PairResult& pair : longer.pairs) {
    const MotionPair* named = result.find(built->bodies[static_cast<std::size_t>(pair.body_a)].name,
                                          built->bodies[static_cast<std::size_t>(pair.body_b)].name);
    ASSERT_TRUE(named);
    EXPECT_EQ(named->verdict, pair.verdict);
    EXPECT_EQ(named->error_bound, pair.error.total());
    ASSERT_EQ(named->contacts.size(), pair.intervals.size());
    for (std::size_t i = 0; i < pair.intervals.size(); ++i) {
      EXPECT_EQ(named->contacts[i].enter, pair.intervals[i].enter);
      EXPECT_EQ(named->contacts[i].exit, pair.intervals[i].exit);
    }
    EXPECT_EQ(named->deepest.depth, pair.deepest.depth);
    EXPECT_EQ(named->on_b_W.force, pair.on_b_W.force);
  }
}

TEST(RobotScene, WithoutMeasuredContactsVerdictsAndDistancesAreTheSame) {
  RobotSceneOptions options;
  options.measure_contacts = false;
  const RobotScene without = RobotScene::parse(kArm, {}, {kPost}, options), with = RobotScene::parse(kArm, {}, {kPost});
  const MotionResult result = without.check(swing(0.0, 1.5)), full = with.check(swing(0.0, 1.5));
  EXPECT_EQ(result.verdict, Verdict::kContact);
  EXPECT_NEAR(result.error_bound, full.error_bound, 1e-9);
  const MotionPair &hit = *result.find("fore", "post"), &same = *full.find("fore", "post");
  ASSERT_EQ(hit.contacts.size(), 1U);
  EXPECT_GE(hit.contacts[0].enter, same.contacts[0].enter - 1e-3);
  EXPECT_LE(hit.contacts[0].exit, same.contacts[0].exit + 1e-3);
  EXPECT_NEAR(hit.deepest.depth, kRadius, hit.deepest.depth_error + 1e-9);
  EXPECT_TRUE(same.on_b_W.force.allFinite());
  EXPECT_GT(same.on_b_W.force.norm(), 0.0);
  EXPECT_TRUE(std::isnan(hit.on_b_W.force.x()));
  const JointPositions joints = {{"shoulder", kPostAngle - 0.3}, {"elbow", 0.0}};
  EXPECT_EQ(without.distance(joints).distance, with.distance(joints).distance);
}

TEST(RobotScene, AnswersSeveralThreads) {
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  const JointPositions joints = {{"shoulder", kPostAngle - 0.3}, {"elbow", 0.0}};
  const MotionResult alone = scene.check(swing(0.0, 1.5));
  const BodyDistance nearest = scene.distance(joints);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k) {
        EXPECT_EQ(scene.check(swing(0.0, 1.5)).find("fore", "post")->contacts.at(0).enter,
                  alone.find("fore", "post")->contacts.at(0).enter);
        EXPECT_EQ(scene.distance(joints).distance, nearest.distance);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace sdf_ccd::robot_scene_test
