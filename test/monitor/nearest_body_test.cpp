#include "sdf_ccd/monitor.h"

#include <gtest/gtest.h>

#include <random>

#include "cancel_moments.h"
#include "monitor/nearest_body.h"
#include "oracle/open_shapes.h"
#include "oracle/scene_case.h"

namespace sdf_ccd::nearest_body_test {

using namespace test;

/// A search in which all bodies are prepared.
class Search {
 public:
  Search(const SceneDescription& description, const BodyOptions& options, bool approximate)
      : scene(build(description, options)),
        search_(scene, std::make_shared<const SceneDescription>(description), nullptr, approximate) {
    for (std::size_t body = 0; body < scene->bodies.size(); ++body) notes.push_back(search_.prepare(body));
  }
  explicit Search(std::vector<BodyDescription> bodies, const BodyOptions& options = fine(0.05),
                  bool approximate = false)
      : Search(SceneDescription{std::move(bodies), {}}, options, approximate) {}

  NearestBody operator()(const std::vector<Isometry3d>& X_WB, const Vector3d& p_W) const {
    return search_.nearest(X_WB, p_W);
  }

  std::shared_ptr<const Scene> scene;
  std::vector<std::string> notes;

 private:
  NearestBodySearch search_;
};

TEST(NearestBody, FindsTheNearestAndItsGradient) {
  // Only the ground's field is planned: the ball needs only a shell.
  const Search search({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  const std::vector<Isometry3d> X_WB = {pose({0, 0, -1}, kPi / 2, {0, 1, 0}), Isometry3d::Identity()};
  EXPECT_TRUE(search.scene->bodies[1].parts.empty());
  const NearestBody nearest = search(X_WB, {0.1, 0.2, 0.3});
  EXPECT_EQ(nearest.body, 0);
  EXPECT_NEAR(nearest.distance, 0.1, 1e-12);
  EXPECT_LT((nearest.gradient_W - Vector3d::UnitX()).norm(), 1e-12);
  const NearestBody in_ball = search(X_WB, {0.06, 0, 0});
  EXPECT_EQ(in_ball.body, 1);
  EXPECT_NEAR(in_ball.distance, -0.04, 1e-12);
  EXPECT_LT((in_ball.gradient_W - Vector3d::UnitX()).norm(), 1e-12);

  const Search two({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))});
  const NearestBody other = two({translation({0, 0, 0}), translation({1, 0, 0})}, {0.8, 0, 0});
  EXPECT_EQ(other.body, 1);
  EXPECT_NEAR(other.distance, 0.1, 1e-12);
  EXPECT_EQ(Search(std::vector<BodyDescription>{})({}, {0, 0, 0}).body, -1);
}

/// Its mesh is too large to be prepared: what is known is that the body is in its box.
TEST(NearestBody, ABodyOfWhichOnlyTheBoxIsKnownIsNotInfinitelyFar) {
  TriangleMesh mesh = boxMesh({0.1, 0.1, 0.1});
  while (mesh.triangles.size() <= 500'000) mesh = merged(mesh, mesh);
  const Search search({body("block", meshShape(std::move(mesh)))});
  EXPECT_NE(search.notes[0].find("ignored but for its box"), std::string::npos) << search.notes[0];
  const NearestBody nearest = search({Isometry3d::Identity()}, {0, 0, 0.05});
  EXPECT_EQ(nearest.body, -1);
  EXPECT_TRUE(std::isinf(nearest.error)) << nearest.error;
  EXPECT_EQ(Search(std::vector<BodyDescription>{})({}, {0, 0, 0}).error, 0.0);
}

/// A bin half a metre wide without a lid: its centre may be on either side. It has a field beside the ball, and none
/// alone.
TEST(NearestBody, ErrorHoldsForEitherSideOfAnOpenMesh) {
  const BodyDescription bin = body("bin", meshShape(binMesh(0.25)));
  for (const bool has_field : {true, false}) {
    std::vector<BodyDescription> bodies = {bin};
    if (has_field) bodies.push_back(body("ball", Primitive(Sphere{0.1})));
    const Search search(bodies, fine(0.05), has_field);
    ASSERT_EQ(search.scene->bodies[0].parts.empty(), !has_field);
    EXPECT_NE(search.notes[0].find("inside and outside are uncertain"), std::string::npos) << search.notes[0];
    std::vector<Isometry3d> X_WB(bodies.size(), translation({9, 0, 0}));
    X_WB[0] = Isometry3d::Identity();
    const NearestBody middle = search(X_WB, {0, 0, -0.05});
    EXPECT_EQ(middle.body, 0);
    EXPECT_LE(middle.distance, 0.0);
    EXPECT_LE(middle.distance - middle.error, -0.2);
    EXPECT_GE(middle.distance + middle.error, 0.2);
    const NearestBody below_lid = search(X_WB, {0, 0, 0.24}), above_lid = search(X_WB, {0, 0, 0.26});
    EXPECT_NEAR(below_lid.distance, -0.01, 1e-3);
    EXPECT_GE(below_lid.distance + below_lid.error, 0.25);
    EXPECT_NEAR(above_lid.distance, 0.01, 1e-3);
    EXPECT_GE(above_lid.distance + above_lid.error, 0.25);
    // Above the opening's centre, the nearest part of the mesh is its rim.
    const Vector3d above(0, 0, 0.3);
    const NearestBody over = search(X_WB, above);
    EXPECT_LE(over.distance - over.error, std::hypot(0.25, 0.05));
    EXPECT_GE(over.distance + over.error, std::hypot(0.25, 0.05));
    EXPECT_LT(search(X_WB, {0, 0, -0.3}).error, 0.02);
  }
}

/// Without another body there is no pair, so no field. A turned torus and a ball in one body, and a box that hides the
/// torus' middle in part.
TEST(NearestBody, NeedsNoField) {
  const Isometry3d X_BG = pose({0.1, -0.2, 0.3}, 1.1, {1, 2, 3});
  BodyDescription mixed = body("mixed", meshShape(torusMesh(0.3, 0.1, 48, 24)));
  mixed.geometry[0].X_BG = X_BG;
  mixed.geometry.push_back({Primitive(Sphere{0.15}), translation({1, 0, 0}), "ball"});
  const Search search({mixed});
  EXPECT_TRUE(search.scene->bodies[0].parts.empty());
  EXPECT_EQ(search.notes[0], "");
  const TriangleMesh torus = torusMesh(0.3, 0.1, 48, 24);
  const std::vector<Isometry3d> X_WB = {pose({-0.5, 0.4, 0.2}, 0.7, {3, 1, -2})};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.6, 0.6);
  int inside = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d p_G(uniform(random), uniform(random), 0.4 * uniform(random));
    const Vector3d p_B = X_BG * p_G;
    const double tube = std::hypot(std::hypot(p_G.x(), p_G.y()) - 0.3, p_G.z()) - 0.1;
    if (std::abs(tube) < 2e-3) continue;  // the triangles are chords
    inside += tube < 0.0;
    const double of_torus = std::copysign(distance(torus, p_G), tube);
    const double of_ball = (p_B - Vector3d(1, 0, 0)).norm() - 0.15;
    const NearestBody found = search(X_WB, X_WB[0] * p_B);
    ASSERT_LE(found.error, 1e-8);
    ASSERT_NEAR(found.distance, std::min(of_torus, of_ball), 1e-9);
    const double step = 1e-6;
    const NearestBody next = search(X_WB, X_WB[0] * p_B + step * found.gradient_W);
    ASSERT_NEAR(found.gradient_W.norm(), 1.0, 1e-9);
    ASSERT_NEAR(next.distance - found.distance, step, 1e-3 * step);
  }
  EXPECT_GT(inside, 20);
}

/// A field of coarse cells rounds the corner of a cube; the cube's triangles do not.
TEST(NearestBody, IsExactWhereFieldsAreCoarse) {
  const std::vector<BodyDescription> bodies = {body("cube", meshShape(boxMesh({0.1, 0.1, 0.1}))),
                                               body("ball", Primitive(Sphere{0.1}))};
  BodyOptions options = fine(0.05);
  options.field.cells = 5;
  const Search exact(bodies, options), approximate(bodies, options, true);
  ASSERT_FALSE(exact.scene->bodies[0].parts.empty());
  const std::vector<Isometry3d> X_WB = {Isometry3d::Identity(), translation({9, 0, 0})};
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d p(uniform(random), uniform(random), uniform(random));
    const Vector3d q = p.cwiseAbs() - Vector3d::Constant(0.1);
    const double truth = q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
    const NearestBody found = exact(X_WB, p), by_field = approximate(X_WB, p);
    ASSERT_NEAR(found.distance, truth, 1e-12 + found.error);
    ASSERT_LT(found.error, 1e-9);
    ASSERT_NEAR(found.gradient_W.norm(), 1.0, 1e-12);
    ASSERT_NEAR(by_field.distance, truth, by_field.error);
    worst = std::max(worst, std::abs(by_field.distance - truth));
  }
  EXPECT_GT(worst, 1e-4);
}

TEST(NearestBody, LeavesOutWhatItCannotPrepare) {
  TriangleMesh many = boxMesh(Vector3d::Constant(0.1));
  many.triangles.resize(500'001, many.triangles.front());
  TriangleMesh broken = boxMesh(Vector3d::Constant(0.1));
  broken.vertices[0].x() = std::nan("");
  BodyDescription lost = body("lost", Primitive(Sphere{0.1}));
  lost.failure = "its file is missing";
  const Search search({body("many", meshShape(many), true), body("broken", meshShape(broken), true), lost,
                       body("empty", Primitive(Sphere{0.1}), true)});
  EXPECT_EQ(search.notes[0],
            "ignored but for its box, which errors allow for: many.stl has 500001 triangles and no field");
  EXPECT_EQ(search.notes[1].find("ignored: "), 0u) << search.notes[1];
  EXPECT_EQ(search.notes[2], "ignored: its file is missing");
  const std::vector<Isometry3d> X_WB(4, translation({1, 0, 0}));
  const NearestBody before = search(X_WB, {0, 0, 0}), at_corner = search(X_WB, {1.1, 0.1, 0.1});
  EXPECT_EQ(before.body, 3);
  EXPECT_NEAR(before.distance, 0.9, 1e-9);
  EXPECT_LT(before.error, 1e-9);
  EXPECT_NEAR(at_corner.distance, 0.1 * (std::sqrt(3.0) - 1.0), 1e-9);
  EXPECT_NEAR(at_corner.error, at_corner.distance, 1e-9);  // the box's corner
}

/// The next version of a world has the same meshes, another world may have others in their place.
TEST(NearestBody, MeshesArePreparedOnce) {
  const std::shared_ptr<MeshDistances> meshes = makeMeshDistances();
  const auto secondsToPrepare = [&](const SceneDescription& description) {
    NearestBodySearch search(build(description), std::make_shared<const SceneDescription>(description), meshes);
    const double seconds = secondsOf([&] { search.prepare(0); });
    const NearestBody nearest = search.nearest({Isometry3d::Identity()}, {0, 0, 2.0});
    EXPECT_EQ(nearest.body, 0);
    const auto& mesh = *std::get<std::shared_ptr<const TriangleMesh>>(description.bodies[0].geometry[0].shape);
    EXPECT_NEAR(nearest.distance, distance(mesh, {0, 0, 2.0}), 1e-9);
    return seconds;
  };
  SceneDescription description{{body("ball", meshShape(icosphere(0.5, 5)))}, {}};
  const double first = secondsToPrepare(description);
  description.bodies[0].name = "the same";
  EXPECT_LT(secondsToPrepare(description), 0.1 * first);
  for (int i = 1; i < 20; ++i) secondsToPrepare({{body("ball", meshShape(icosphere(0.1 * i, 2)))}, {}});
}

}  // namespace sdf_ccd::nearest_body_test
