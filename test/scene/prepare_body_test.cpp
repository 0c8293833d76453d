#include "sdf_ccd/body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "oracle/failure.h"
#include "oracle/shapes.h"
#include "scene/body_triangles.h"
#include "scene/build_body.h"
#include "sdf_ccd/sdf_ccd.h"
#include "shell/point_shell.h"

namespace sdf_ccd::prepare_body_test {

const Accuracy kMillimetre{1e-3, {}};

Isometry3d at(double x, double y, double z) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(PrepareBody, PassesThroughATable) {
  const Body table = prepareBody("table", Box::fromSize({1.0, 1.0, 0.02}), kMillimetre);
  const Body part = prepareBody("part", test::boxMesh({0.02, 0.02, 0.02}), kMillimetre);
  Monitor monitor({table, part});
  const Isometry3d X_WT = Isometry3d::Identity();

  const CycleResult& clear = monitor.check({{X_WT, X_WT}, {at(0.0, 0.0, 0.2), at(0.3, 0.0, 0.2)}});
  EXPECT_EQ(clear.verdict, Verdict::kClear);
  EXPECT_LT(clear.error_bound, 1.1e-3);

  const CycleResult& through = monitor.check({{X_WT, X_WT}, {at(0.0, 0.0, 0.2), at(0.0, 0.0, -0.2)}}, 2.0);
  EXPECT_EQ(through.verdict, Verdict::kContact);
  ASSERT_EQ(through.pairs.size(), 1u);
  ASSERT_EQ(through.pairs[0].intervals.size(), 1u);
  // At 0.2 m/s they touch while the part's centre is within 0.03 m of the table's.
  EXPECT_NEAR(through.pairs[0].intervals[0].enter, 0.85, 0.01);
  EXPECT_NEAR(through.pairs[0].intervals[0].exit, 1.15, 0.01);
}

TEST(PrepareBody, AnswersSegments) {
  const Body part = prepareBody("part", test::boxMesh({0.1, 0.1, 0.1}), kMillimetre);
  const Intervals inside = segmentIntervals(part.field(), {{-0.4, 0.0, 0.0}, {0.4, 0.0, 0.0}});
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_NEAR(inside[0].enter, 0.375, 2e-3);
  EXPECT_NEAR(inside[0].exit, 0.625, 2e-3);
}

TEST(PrepareBody, SeesWhatCrossesAnOpenMesh) {
  TriangleMesh bin = test::boxMesh({0.1, 0.1, 0.1});
  bin.triangles.resize(bin.triangles.size() - 2);  // without one side
  Monitor monitor({prepareBody("bin", bin, kMillimetre), prepareBody("ball", Sphere{0.02}, kMillimetre)});
  const Isometry3d still = Isometry3d::Identity();
  EXPECT_NE(monitor.check({{still, still}, {still, still}}).verdict, Verdict::kContact);
  bool crosses = false;
  for (const Vector3d& way : {Vector3d(Vector3d::UnitX()), Vector3d(Vector3d::UnitY()), Vector3d(Vector3d::UnitZ())})
    for (const double side : {-0.1, 0.1}) {
      const Isometry3d on = at(side * way.x(), side * way.y(), side * way.z());
      crosses |= monitor.check({{still, still}, {on, on}}).verdict == Verdict::kContact;
    }
  EXPECT_TRUE(crosses);
}

TEST(PrepareBody, GroundHasNoShell) {
  const Body ground = prepareBody("ground", HalfSpace{Vector3d::UnitZ(), 0.0}, kMillimetre);
  EXPECT_EQ(ground.shell->size(), 0u);
  Monitor monitor({ground, prepareBody("ball", Box::fromSize({0.2, 0.2, 0.2}), kMillimetre)});
  const Isometry3d still = Isometry3d::Identity();
  EXPECT_EQ(monitor.check({{still, still}, {at(0, 0, 0.2), at(0, 0, 0.05)}}).verdict, Verdict::kContact);
}

TEST(PrepareBody, RefusesPosesThatAreNone) {
  BodyDescription scaled;
  scaled.name = "scaled";
  Isometry3d X_BG = Isometry3d::Identity();
  X_BG.linear() *= 2.0;
  scaled.geometry.push_back({Primitive(Box::fromSize({0.2, 0.2, 0.2})), X_BG, "box"});
  EXPECT_EQ(test::failureOf<std::invalid_argument>([&] { prepareBody(scaled, kMillimetre); }),
            "scaled: the pose of box's rotation is not orthonormal");
  scaled.geometry[0].X_BG.setIdentity();
  scaled.X_frame_B.translation().x() = NAN;
  EXPECT_THROW(prepareBody(scaled, kMillimetre), std::invalid_argument);
}

TEST(PrepareBody, TwoWithoutAShellAreNotPassedOver) {
  Body ground = prepareBody("ground", HalfSpace{Vector3d::UnitZ(), 0.0}, kMillimetre);
  Body wall = prepareBody("wall", HalfSpace{Vector3d::UnitX(), -1.0}, kMillimetre);
  Monitor free({ground, wall});
  const Isometry3d still = Isometry3d::Identity();
  EXPECT_EQ(free.check({{still, still}, {still, still}}).verdict, Verdict::kNotChecked);
  ground.is_world = wall.is_world = true;
  EXPECT_NO_THROW(Monitor({ground, wall}));
}

TEST(PrepareBody, PosesThatDoNotTellTheWayAreRefused) {
  Monitor monitor({prepareBody("bar", Box::fromSize({0.2, 0.04, 0.04}), kMillimetre),
                   prepareBody("box", Box::fromSize({0.04, 0.04, 0.04}), kMillimetre)});
  const Isometry3d still = at(0, 1, 0), start = Isometry3d::Identity(),
                   half(Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitZ())),
                   less(Eigen::AngleAxisd(3.1, Vector3d::UnitZ()));
  EXPECT_THROW(monitor.check({{start, half}, {still, still}}), std::invalid_argument);
  EXPECT_EQ(monitor.check({{start, less}, {still, still}}).verdict, Verdict::kClear);
  Isometry3d mirrored = start;
  mirrored.linear()(0, 0) = -1.0;
  EXPECT_EQ(monitor.check({{start, mirrored}, {still, still}}).verdict, Verdict::kNotChecked);
}

TEST(PrepareBody, SaysWhatIsWrong) {
  EXPECT_THROW(prepareBody("none", TriangleMesh{}, kMillimetre), std::invalid_argument);
  EXPECT_THROW(prepareBody("flat", Sphere{-1.0}, kMillimetre), std::invalid_argument);
  EXPECT_THROW(prepareBody("exact", Sphere{1.0}, {0.0, {}}), std::invalid_argument);
  const Body ball = prepareBody("ball", Box::fromSize({0.2, 0.2, 0.2}), kMillimetre);
  Body empty;
  empty.name = "empty";
  EXPECT_THROW(Monitor({ball, empty}), std::invalid_argument);
  empty.failure = "lost";
  Monitor lost({ball, empty});
  EXPECT_EQ(lost.check({{at(0, 0, 0), at(0, 0, 0)}, {at(5, 0, 0), at(5, 0, 0)}}).verdict, Verdict::kNotChecked);
  EXPECT_THROW(Monitor({ball, ball}), std::invalid_argument);
  Monitor monitor({ball, prepareBody("other", Box::fromSize({0.2, 0.2, 0.2}), kMillimetre)});
  EXPECT_THROW(monitor.check({}), std::invalid_argument);
  EXPECT_THROW(monitor.check({{at(0, 0, 0), at(0, 0, 0)}, {at(0, 0, 0)}}), std::invalid_argument);
}

TEST(PrepareBody, AShellThatWouldBeTooLargeIsRefusedBeforeTheFieldIsBuilt) {
  BodyDescription ball;
  ball.name = ball.frame = "ball";
  ball.geometry.push_back(
      {std::make_shared<const TriangleMesh>(test::icosphere(0.1, 2)), Isometry3d::Identity(), "ball.stl"});
  BodyOptions options = optionsFor({1e-3, {}});
  options.divides_max_error = false;
  options.shell.max_points = 1000;
  options.field.max_bytes = 100000;  // the field would be refused, too
  const auto failure = [&] {
    MeshPool pool(options);
    return buildBody(ball, {}, options, pool, {}).body.failure;
  };
  EXPECT_NE(failure().find("needs more than 1000 points"), std::string::npos) << failure();
  options.shell.max_points = kMaxShellPoints;
  EXPECT_NE(failure().find("field: "), std::string::npos) << failure();
}

TEST(SharedBodies, AreHeldOnceWhileSomebodyHoldsThem) {
  const auto describe = [](const std::string& name) {
    BodyDescription body;
    body.name = body.frame = name;
    body.X_frame_B = at(name == "left" ? 1.0 : 2.0, 0.0, 0.0);
    body.geometry.push_back(
        {std::make_shared<const TriangleMesh>(test::boxMesh({0.05, 0.05, 0.05})), at(0, 0, 0.1), "box"});
    return body;
  };
  BodyOptions options = optionsForContacts(0.01);
  options.is_shared = true;
  const auto build = [&](const std::string& name) {  // each by its own monitor
    MeshPool pool(options);
    BuiltBody built = buildBody(describe(name), {}, options, pool, {});
    built.body.triangles = trianglesOf(describe(name), pool);
    return built;
  };
  {
    const BuiltBody left = build("left"), right = build("right");
    EXPECT_NE(left.report.field.text, "shared");
    EXPECT_EQ(right.report.field.text, "shared");
    EXPECT_GT(left.report.field_bytes, 0u);
    EXPECT_GT(left.report.shell_bytes, 0u);
    EXPECT_EQ(right.report.field_bytes + right.report.shell_bytes, 0u) << "it takes no more";
    EXPECT_EQ(right.report.shell_points, left.report.shell_points);
    EXPECT_EQ(&*left.body.shell, &*right.body.shell);
    EXPECT_EQ(&*left.body.tree, &*right.body.tree);
    EXPECT_EQ(left.body.triangles, right.body.triangles);
    EXPECT_EQ(right.body.name, "right");
    EXPECT_EQ(right.body.frame, "right");
    EXPECT_EQ(right.body.X_frame_B.translation().x(), 2.0);
    options.shell.spacing *= 0.5;
    options.points_across = 0.0;
    EXPECT_NE(build("right").report.field.text, "shared") << "it is to be finer";
    options.is_shared = false;
    EXPECT_NE(build("right").report.field.text, "shared");
  }
  options = optionsForContacts(0.01);
  options.is_shared = true;
  EXPECT_NE(build("left").report.field.text, "shared") << "nobody holds it any more";
}

/// The two arms of a robot.
TEST(SharedBodies, OfOneSceneAreHeldOnceInAnyCase) {
  const BodyOptions options = optionsForContacts(0.01);
  MeshPool pool(options);
  const auto build = [&](const std::string& name, double x) {
    BodyDescription description;
    description.name = description.frame = name;
    description.geometry.push_back(
        {std::make_shared<const TriangleMesh>(test::boxMesh({0.05, 0.05, 0.05})), at(x, 0, 0.1), "box"});
    BuiltBody built = buildBody(description, {}, options, pool, {});
    built.body.triangles = trianglesOf(description, pool);
    return built;
  };
  const BuiltBody left = build("left", 0.0), right = build("right", 0.0), other = build("other", 0.1);
  EXPECT_EQ(&*left.body.shell, &*right.body.shell);
  EXPECT_EQ(left.body.triangles, right.body.triangles);
  EXPECT_GT(left.report.shell_bytes, 0u);
  EXPECT_EQ(right.report.shell_bytes, 0u);
  EXPECT_NE(&*left.body.shell, &*other.body.shell) << "placed elsewhere in its link";
  EXPECT_EQ(other.report.field.text, "shared") << "the mesh's field is the same";
  EXPECT_GT(other.report.shell_bytes, 0u);
}

/// Bodies that differ from the first one in a single respect.
TEST(SharedBodies, AreOfTheSameContentAndOptions) {
  BodyOptions options;
  options.field.cell_size = 0.02;
  options.shell.spacing = 0.02;
  options.is_shared = true;
  const auto mesh = std::make_shared<const TriangleMesh>(test::boxMesh({0.05, 0.04, 0.03}));
  BodyDescription body;
  body.name = body.frame = "body";
  body.geometry.push_back({mesh, at(0, 0, 0.1), "box"});
  const auto make = [](const BodyDescription& description, const BodyOptions& with) {
    MeshPool pool(with);
    return buildBody(description, {}, with, pool, {});
  };
  const BuiltBody first = make(body, options);
  ASSERT_TRUE(first.body.content);
  EXPECT_EQ(make(body, options).body.content, first.body.content);
  const auto expectOther = [&](const BodyDescription& description, const BodyOptions& with, const char* what) {
    const BuiltBody other = make(description, with);
    EXPECT_NE(other.body.content, first.body.content) << what;
    return other;
  };

  BodyOptions other = options;
  other.field.cells = 0;  // is refused, unlike an absent number
  EXPECT_FALSE(expectOther(body, other, "no cells").body.failure.empty());
  other = options;
  other.max_error = 0.0;
  expectOther(body, other, "max_error");
  other = options;
  other.shell.seed = (std::uint64_t{1} << 60) + 1;
  const BuiltBody seeded = make(body, other);
  ++other.shell.seed;
  EXPECT_NE(make(body, other).body.content, seeded.body.content) << "seeds that are one as doubles";

  BodyDescription with_cells = body;
  with_cells.geometry[0].cell_size = 0.0;
  EXPECT_FALSE(expectOther(with_cells, options, "no cell size").body.failure.empty());
  BodyDescription mirrored = body, reordered = body;
  TriangleMesh changed = *mesh;
  for (Vector3d& v : changed.vertices) v.x() = -v.x();
  mirrored.geometry[0].shape = std::make_shared<const TriangleMesh>(changed);
  expectOther(mirrored, options, "mirrored");
  changed = *mesh;
  std::reverse(changed.triangles.begin(), changed.triangles.end());
  reordered.geometry[0].shape = std::make_shared<const TriangleMesh>(changed);
  expectOther(reordered, options, "order of triangles");
}

}  // namespace sdf_ccd::prepare_body_test
