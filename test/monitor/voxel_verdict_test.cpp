// Verdicts about voxel maps against exact distances to boxes.
#include <gtest/gtest.h>

#include "monitor/voxel_case.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"

namespace sdf_ccd::voxel_verdict_test {

using namespace test;

/// Distance of the segment from the box [m]: the distance along it is convex.
double distanceTo(const AlignedBox3d& box, const Vector3d& start, const Vector3d& end) {
  double low = 0.0, high = 1.0;
  const auto at = [&](double s) { return box.exteriorDistance(Vector3d(start + s * (end - start))); };
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (at(a) <= at(b) ? high : low) = at(a) <= at(b) ? b : a;
  }
  return std::min({at(0.5 * (low + high)), at(0.0), at(1.0)});
}

double distanceTo(const Voxels& voxels, const Vector3d& start, const Vector3d& end) {
  double least = 1e9;
  for (const auto& v : voxels) {
    const Vector3d low = kSize * Vector3d(v[0], v[1], v[2]);
    least = std::min(least, distanceTo({low, low + Vector3d::Constant(kSize)}, start, end));
  }
  return least;
}

/// The tiles of a map and a ball.
struct BallInMap {
  BallInMap(const Voxels& voxels, double radius) {
    VoxelMapOptions options;
    options.band = 2.0 * kSize;
    VoxelMap map("map", "world", options);
    VoxelMap::Change change = map.update(gridOf(voxels, options), {});
    std::vector<BodyDescription> bodies = std::move(change.made);
    bodies.insert(bodies.begin(), body("ball", Primitive(Sphere{radius})));
    scene = build(std::move(bodies), fine(0.1 * radius));
    monitor = std::make_unique<Monitor>(scene, MonitorOptions());
  }

  const CycleResult& move(const Vector3d& start, const Vector3d& end, bool wants_contacts = false) {
    CycleMotion motion;
    motion.times = {0.0, 0.1};
    motion.X_WB.assign(scene->bodies.size(), still(Isometry3d::Identity()));
    motion.X_WB[0] = {translation(start), translation(end)};
    CycleRequest request;
    request.contacts = request.wrenches = wants_contacts;
    return monitor->run(motion, request);
  }

  std::shared_ptr<const Scene> scene;
  std::unique_ptr<Monitor> monitor;
};

TEST(VoxelVerdict, ABallAmongRandomVoxelsToATenthOfAMillimetre) {
  Random random(11);
  int clear = 0, contact = 0, near = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Voxels voxels;
    const double share = uniform(random, 0.01, 0.2);
    for (int i = 0; i < 20 * 20 * 8; ++i)
      if (uniform(random, 0.0, 1.0) < share) voxels.insert({i % 20 - 10, i / 20 % 20 - 10, i / 400 - 4});
    const double radius = uniform(random, 0.2, 1.2) * kSize;
    BallInMap ball(voxels, radius);
    for (const PlannedPair& pair : ball.scene->pairs) ASSERT_TRUE(ball.scene->bodies[pair.body_b].triangles);
    Vector3d start(-1.0, 0.0, 0.0);
    for (int step = 0; step < 100; ++step) {
      Vector3d end = uniformIn(random, {Vector3d(-0.6, -0.6, -0.3), Vector3d(0.6, 0.6, 0.3)});
      if (step % 2 == 0) end = start + 0.1 * (end - start);
      const double gap = distanceTo(voxels, start, end) - radius;
      const Verdict verdict = ball.move(start, end).verdict;
      if (std::abs(gap) > 1e-4) {
        EXPECT_EQ(verdict, gap > 0.0 ? Verdict::kClear : Verdict::kContact) << trial << " " << step << " " << gap;
      }
      ++(gap > 1e-4 ? clear : gap < -1e-4 ? contact : near);
      start = end;
    }
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(contact, 100);
}

TEST(VoxelVerdict, TrianglesAreCounted) {
  Voxels hills;
  for (int x = 0; x < 60; ++x)
    for (int y = 0; y < 60; ++y)
      for (int z = 0; z < 4 + int(3.0 * std::sin(0.3 * x) * std::cos(0.2 * y)); ++z) hills.insert({x, y, z});
  VoxelMapOptions options;
  VoxelMap map("map", "world", options);
  SceneDescription description{map.update(gridOf(hills, options), {}).made, {}};
  double faces = 0.0;
  for (BodyDescription& tile : description.bodies) {
    tile.geometry[0].field.reset();  // to be built here, like that of a map from a file
    faces += double(std::get<std::shared_ptr<const TriangleMesh>>(tile.geometry[0].shape)->triangles.size());
  }
  description.bodies.push_back(body("ball", Primitive(Sphere{0.05})));
  double bytes = 0.0;
  for (const BodyReport& report : buildScene(description, planScene(description), fine()).reports)
    bytes += double(report.field_bytes + report.shell_bytes);
  EXPECT_GT(bytes, 10.0 * faces);
}

TEST(VoxelVerdict, ABallInsideABlockTouchesNoFace) {
  Voxels voxels;
  for (int i = 0; i < 16 * 16 * 16; ++i) voxels.insert({i % 16, i / 16 % 16, i / 256});
  const Vector3d middle = Vector3d::Constant(8.0 * kSize);
  BallInMap solid(voxels, 0.4 * kSize);
  EXPECT_EQ(solid.move(middle, middle).verdict, Verdict::kContact);
  for (int i = 0; i < 27; ++i) voxels.erase({7 + i % 3, 7 + i / 3 % 3, 7 + i / 9});
  BallInMap hollow(voxels, 0.4 * kSize);
  const Vector3d in_cavity = Vector3d::Constant(8.5 * kSize);
  EXPECT_EQ(hollow.move(in_cavity, in_cavity).verdict, Verdict::kClear);
  EXPECT_EQ(hollow.move(in_cavity, in_cavity + Vector3d(1.2 * kSize, 0, 0)).verdict, Verdict::kContact);
}

TEST(VoxelVerdict, AVoxelInsideALinkTouchesNoFace) {
  BallInMap ball({{0, 0, 0}}, 3.0 * kSize);
  const Vector3d beside(3.7 * kSize, 0.5 * kSize, 0.5 * kSize);
  EXPECT_EQ(ball.move(Vector3d::Zero(), Vector3d::Zero()).verdict, Verdict::kContact);
  EXPECT_EQ(ball.move({4.1 * kSize, 0.5 * kSize, 0.5 * kSize}, {4.1 * kSize, 0.5 * kSize, 0.5 * kSize}).verdict,
            Verdict::kClear);
  EXPECT_EQ(ball.move(beside, beside).verdict, Verdict::kContact);
}

// The field of a tile is half a voxel in doubt: that the ball lies inside is known without it.
TEST(VoxelVerdict, ABallInsideASingleVoxelIsContactAllTheTime) {
  BallInMap ball({{0, 0, 0}}, 0.05 * kSize);
  for (const double x : {0.1, 0.3, 0.5, 0.94})
    for (const bool wants_contacts : {false, true})
      for (const bool moves : {false, true}) {
        const Vector3d start(x * kSize, 0.3 * kSize, 0.5 * kSize);
        const Vector3d end = moves ? Vector3d(x * kSize, 0.6 * kSize, 0.4 * kSize) : start;
        const CycleResult& result = ball.move(start, end, wants_contacts);
        ASSERT_EQ(result.verdict, Verdict::kContact) << x << " " << wants_contacts << " " << moves;
        const auto in_contact = [](const PairResult& each) { return each.verdict == Verdict::kContact; };
        const PairResult& pair = *std::find_if(result.pairs.begin(), result.pairs.end(), in_contact);
        ASSERT_EQ(pair.intervals.size(), 1U);
        EXPECT_EQ(pair.intervals[0].enter, 0.0);
        EXPECT_EQ(pair.intervals[0].exit, 0.1);
        EXPECT_LE(AlignedBox3d(Vector3d::Zero(), Vector3d::Constant(kSize)).exteriorDistance(pair.deepest.p_W), 1e-12);
      }
}

}  // namespace sdf_ccd::voxel_verdict_test
