#include "monitor/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <set>

#include "monitor/scene_case.h"
#include "monitor/voxel_mask.h"
#include "oracle/files.h"
#include "oracle/random.h"
#include "oracle/test_data.h"
#include "sdf_ccd/monitor/world.h"

namespace sdf_ccd {
namespace {

using namespace test;

constexpr double kSize = 0.05;  // size of a voxel [m]
constexpr int kMiddle = 32768;

using Voxels = std::set<std::array<int, 3>>;  // counted from the origin

VoxelGrid gridOf(const Voxels& voxels, const VoxelMapOptions& options) {
  VoxelGrid grid(kSize, options);
  for (const auto& v : voxels) grid.add(Vector3i(kMiddle + v[0], kMiddle + v[1], kMiddle + v[2]), 1, true);
  return grid;
}

VoxelMask ballMask(const Vector3d& center, double radius) {
  VoxelMask mask;
  mask.center_M = center;
  mask.radius = radius;
  mask.distance = [=](const Vector3d& p) { return (p - center).norm() - radius; };
  return mask;
}

/// A map maintained from its changes.
class Kept {
 public:
  void take(const VoxelMap::Change& change) {
    for (const std::string& name : change.removed) ASSERT_EQ(tiles_.erase(name), 1U) << name;
    for (std::size_t i = 0; i < change.made.size(); ++i) tiles_.insert_or_assign(change.made[i].name, change.fields[i]);
  }
  double distance(const Vector3d& p) const {
    double least = 1e9;
    for (const auto& [name, field] : tiles_) least = std::min(least, field.sample(p).value);
    return least;
  }
  std::size_t size() const { return tiles_.size(); }

 private:
  std::map<std::string, DistanceField> tiles_;
};

double distanceTo(const Voxels& voxels, const Vector3d& p) {
  double least = 1e9;
  for (const auto& v : voxels) {
    const Vector3d low = kSize * Vector3d(v[0], v[1], v[2]);
    least = std::min(least, AlignedBox3d(low, low + Vector3d::Constant(kSize)).exteriorDistance(p));
  }
  return least;
}

TEST(VoxelMap, AChangedMapIsAsOneMadeAnew) {
  Random random(7);
  const VoxelMapOptions options;
  Voxels voxels;
  for (int x = -30; x < 30; ++x)
    for (int y = -30; y < 30; ++y) voxels.insert({x, y, -3});  // a floor across tiles
  VoxelMap map("map", "world", options);
  Kept kept;
  for (int scan = 0; scan < 12; ++scan) {
    std::size_t changed = 0;
    std::set<std::array<int, 3>> tiles;
    for (int i = 0; i < (scan == 0 ? 0 : 30); ++i) {
      const std::array<int, 3> v{int(uniform(random, -30, 30)), int(uniform(random, -30, 30)),
                                 int(uniform(random, -6, 20))};
      if (!voxels.erase(v)) voxels.insert(v);
      ++changed;
    }
    const VoxelMap::Change change = map.take(gridOf(voxels, options), {});
    EXPECT_EQ(change.occupied, voxels.size());
    kept.take(change);
    EXPECT_LE(change.made.size(), scan == 0 ? 100U : 8 * changed);
    for (int i = 0; i < 300; ++i) {
      const auto& near = *std::next(voxels.begin(), long(uniform(random, 0.0, 0.99) * double(voxels.size())));
      const Vector3d p = kSize * Vector3d(near[0] + uniform(random, -1, 2), near[1] + uniform(random, -1, 2),
                                          near[2] + uniform(random, -1, 2));
      const double truth = distanceTo(voxels, p), said = kept.distance(p);
      if (truth > 0.0) {
        EXPECT_NEAR(said, truth, 0.88 * 0.5 * kSize);
      } else {
        EXPECT_LT(said, 0.88 * 0.5 * kSize);
      }
    }
    EXPECT_TRUE(map.take(gridOf(voxels, options), {}).made.empty()) << "nothing has changed";
  }
  const VoxelMap::Change gone = map.take(VoxelGrid(kSize, options), {});
  kept.take(gone);
  EXPECT_EQ(kept.size(), 0U);
}

TEST(VoxelMap, InsideAWallIsDeepWhereTilesMeet) {
  Voxels voxels;
  for (int x = -20; x < 20; ++x)
    for (int y = -20; y < 20; ++y)
      for (int z = -20; z < 20; ++z) voxels.insert({x, y, z});
  VoxelMap map("map", "world", {});
  Kept kept;
  kept.take(map.take(gridOf(voxels, {}), {}));
  EXPECT_GT(kept.size(), 7U);
  for (double s = -0.8; s < 0.8; s += 0.01)
    for (const Vector3d& p : {Vector3d(s, 0.4, 0.5), Vector3d(0.1, s, -0.5), Vector3d(0.5, 0.1, s)})
      EXPECT_LT(kept.distance(p), -0.6 * kSize) << p.transpose();
}

TEST(VoxelMap, WhatTheRobotFillsDoesNotCount) {
  Voxels voxels;
  for (int x = -10; x < 10; ++x)
    for (int y = -10; y < 10; ++y)
      for (int z = -10; z < 10; ++z) voxels.insert({x, y, z});
  VoxelMapOptions options;
  options.padding = 0.04;
  const VoxelMask ball = ballMask({0.1, 0.0, 0.0}, 0.2);
  VoxelMap map("map", "world", options);
  Kept kept;
  const VoxelMap::Change change = map.take(gridOf(voxels, options), {ball});
  kept.take(change);
  Voxels left;
  for (const auto& v : voxels) {
    const Vector3d center = kSize * Vector3d(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
    if (ball.distance(center) > 0.04 + 0.5 * kSize) left.insert(v);
  }
  EXPECT_EQ(change.occupied, left.size());
  EXPECT_EQ(change.masked, voxels.size() - left.size());
  EXPECT_GT(kept.distance(ball.center_M), 0.2);
  // When the mask is gone, the voxels there count again.
  kept.take(map.take(gridOf(voxels, options), {}));
  EXPECT_LT(kept.distance(ball.center_M), 0.0);
}

TEST(VoxelMap, UnknownSpaceIsWhatIsAskedFor) {
  VoxelMapOptions options;
  options.unknown = UnknownSpace::kOccupied;
  const auto gridOfFree = [&] {
    VoxelGrid grid(kSize, options);
    grid.add(Vector3i::Constant(kMiddle), 16, false);  // free from 0 to 0.8 m
    grid.add(Vector3i::Constant(kMiddle + 30), 1, true);
    return grid;
  };
  VoxelMap all("map", "world", options);
  Kept kept;
  kept.take(all.take(gridOfFree(), {}));
  EXPECT_GT(kept.distance({0.4, 0.4, 0.4}), 0.1);
  EXPECT_LT(kept.distance({1.2, 0.4, 0.4}), 0.0);

  options.unknown = UnknownSpace::kOccupiedNear;
  options.near_distance = 0.3;
  const VoxelMask ball = ballMask({0.75, 0.4, 0.4}, 0.1);
  VoxelMap near("map", "world", options);
  Kept kept_near;
  kept_near.take(near.take(gridOfFree(), {ball}));
  EXPECT_GT(kept_near.distance({0.4, 0.4, 0.4}), 0.1);
  EXPECT_LT(kept_near.distance({1.05, 0.4, 0.4}), 0.0);  // unknown, 0.2 m from the ball
  EXPECT_GT(kept_near.distance({1.5, 0.4, 0.4}), 0.2);   // unknown, but far away
}

TEST(VoxelMap, AMaskOfAnotherTimeHidesNoOccupiedVoxels) {
  VoxelMapOptions options;
  options.unknown = UnknownSpace::kOccupiedNear;
  options.near_distance = 0.3;
  VoxelGrid grid(kSize, options);
  const Vector3i voxel(kMiddle + 10, kMiddle + 8, kMiddle + 8);
  grid.add(voxel, 1, true);
  const Vector3d p = kSize * ((voxel.array() - kMiddle).cast<double>() + 0.5).matrix();
  VoxelMask ball = ballMask(p, 0.15);
  ball.only_unknown = true;
  VoxelMap map("map", "world", options);
  Kept kept;
  kept.take(map.take(std::move(grid), {ball}));
  EXPECT_LT(kept.distance(p), 0.0);
  EXPECT_GT(kept.distance(p + Vector3d(0.1, 0.0, 0.0)), 0.0);  // unknown, and filled by the ball
  EXPECT_LT(kept.distance(p + Vector3d(0.3, 0.0, 0.0)), 0.0);  // unknown, near the ball
}

/// What lies in an open box is not the box.
TEST(VoxelMap, WhatIsInAnOpenBodyCounts) {
  TriangleMesh bin = boxMesh({0.4, 0.4, 0.4});
  const auto is_lid = [&](const Vector3i& t) {
    return std::min({bin.vertices[t[0]].z(), bin.vertices[t[1]].z(), bin.vertices[t[2]].z()}) > 0.0;
  };
  bin.triangles.erase(std::remove_if(bin.triangles.begin(), bin.triangles.end(), is_lid), bin.triangles.end());
  ASSERT_EQ(bin.triangles.size(), 10u);
  const SceneDescription description{{body("bin", meshShape(bin)), body("tool", Primitive(Sphere{0.05}))}, {}};
  const auto scene = build(description, fine(0.02));
  for (const UnknownSpace unknown : {UnknownSpace::kFree, UnknownSpace::kOccupied}) {
    VoxelMapOptions options;
    options.unknown = unknown;
    const auto mask = maskOf(scene->bodies[0], description.bodies[0], Isometry3d::Identity());
    ASSERT_TRUE(mask);
    VoxelMap map("map", "world", options);
    Kept kept;
    kept.take(map.take(gridOf({{0, 0, 0}, {0, 0, 7}, {7, 0, 0}, {0, 0, -8}, {3, 7, 2}}, options), {*mask}));
    EXPECT_LT(kept.distance({0.025, 0.025, 0.025}), 0.0) << "in its middle";
    EXPECT_LT(kept.distance({0.025, 0.025, 0.375}), 0.0) << "in its opening";
    EXPECT_GT(kept.distance({0.375, 0.025, 0.025}), 0.0) << "a wall";
    EXPECT_GT(kept.distance({0.025, 0.025, -0.375}), 0.0) << "the floor";
    EXPECT_GT(kept.distance({0.175, 0.375, 0.125}), 0.0) << "a wall";
    EXPECT_GT(kept.distance({0.2, 0.2, -0.2}), 0.0) << "unknown space inside";
  }
}

/// Far from a surface a field knows only loose bounds of the distance: they hid voxels up to 15 cm from a link.
TEST(VoxelMap, OnlyWhatIsWithinThePaddingIsHidden) {
  constexpr double kRing = 0.4, kTube = 0.08;
  BodyDescription awaited = body("map/awaited", meshShape(boxMesh({0.1, 0.1, 0.1})), true);
  awaited.map = "map";
  awaited.failure = "no map yet";
  awaited.geometry.front().watertight_voxels = true;
  const SceneDescription description{{body("ring", meshShape(torusMesh(kRing, kTube, 64, 32))), awaited}, {}};
  for (const double max_error : {0.01, 0.002}) {
    BodyOptions resolution = fine();
    resolution.field = FieldOptions();
    resolution.field.max_error = max_error;
    const auto scene = build(description, resolution);
    const auto mask = maskOf(scene->bodies[0], description.bodies[0], Isometry3d::Identity());
    ASSERT_TRUE(mask);
    const VoxelMapOptions options;
    const double pad = options.padding + 0.5 * kSize;
    ASSERT_LT(maskError(*scene), pad);
    Random random(3);
    int hidden = 0;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Array3i v = (10.0 * uniform(random, 0.0, 1.3) * direction(random).array()).cast<int>();
      const Vector3d center = kSize * (v.cast<double>() + 0.5).matrix();
      const double distance = std::hypot(std::hypot(center.x(), center.y()) - kRing, center.z()) - kTube;
      VoxelMap map("map", "world", options);
      const VoxelMap::Change change = map.take(gridOf({{v.x(), v.y(), v.z()}}, options), {*mask});
      constexpr double kChords = 0.001;  // between the ring and its triangles [m]
      if (std::abs(distance - pad) <= kChords) continue;
      EXPECT_EQ(change.masked, distance < pad ? 1U : 0U) << center.transpose() << ", " << distance;
      hidden += int(change.masked);
    }
    EXPECT_GT(hidden, 30);
    VoxelMapOptions unknown;
    unknown.unknown = UnknownSpace::kOccupied;
    VoxelMap map("map", "world", unknown);
    Kept kept;
    kept.take(map.take(gridOf({{-12, -12, -12}, {12, 12, 12}}, unknown), {*mask}));
    EXPECT_LT(kept.distance(Vector3d::Constant(0.025)), 0.0) << "unknown space within the ring";
    EXPECT_GT(kept.distance({kRing, 0.0, 0.0}), 0.0) << "unknown space in the ring's tube";
  }
}

TEST(VoxelMap, FreeSpaceOfMoreTilesThanMayBeIsKnown) {
  constexpr int kSide = 1024, kTo = kMiddle + kSide;  // a leaf from 0 to 51.2 m
  for (const UnknownSpace unknown : {UnknownSpace::kOccupiedNear, UnknownSpace::kOccupied}) {
    VoxelMapOptions options;
    options.unknown = unknown;
    options.near_distance = 0.3;
    VoxelGrid grid(kSize, options);
    grid.add(Vector3i::Constant(kMiddle), kSide, false);
    for (const int far : {kMiddle + 2, kTo + 20}) grid.add(Vector3i(far, far, kMiddle + 500), 1, true);
    for (int i = 0; i < 100; ++i) grid.add(Vector3i(kMiddle + 10 * i, kMiddle + 10 * i, kMiddle + 500), 1, false);
    VoxelMap map("map", "world", options);
    Kept kept;
    kept.take(map.take(std::move(grid), {ballMask({20.0, 20.0, 25.0}, 0.1), ballMask({51.1, 51.1, 25.0}, 0.1)}));
    EXPECT_GT(kept.distance({20.0, 20.0, 25.0}), 0.3);
    EXPECT_GT(kept.distance({20.2, 20.1, 25.1}), 0.1);
    EXPECT_GT(kept.distance({51.0, 51.0, 25.0}), 0.0);
    EXPECT_LT(kept.distance({51.35, 51.15, 25.0}), 0.0);  // beyond the leaf
    EXPECT_THROW(grid.add(Vector3i::Constant(kMiddle + 1), kSide, false), std::invalid_argument);
    EXPECT_THROW(grid.add(Vector3i::Constant(kMiddle), kSide - 1, false), std::invalid_argument);
  }
}

TEST(VoxelMap, RefusesWhatIsTooLarge) {
  EXPECT_THROW(VoxelGrid(0.0, {}), std::invalid_argument);
  EXPECT_THROW(VoxelGrid(std::numeric_limits<double>::quiet_NaN(), {}), std::invalid_argument);
  EXPECT_THROW(VoxelGrid(1e9, {}), std::invalid_argument);
  VoxelGrid grid(kSize, {});
  EXPECT_THROW(grid.add(Vector3i::Zero(), 1 << 16, true), std::runtime_error);
  EXPECT_THROW(grid.addOctree(nullptr, 0, "CountingOcTree", true), std::runtime_error);
  VoxelMapOptions few;
  few.max_tiles = 10;
  VoxelGrid spread(kSize, few);
  EXPECT_THROW(
      {
        for (int i = 0; i < 50; ++i) spread.add(Vector3i(100 * i, 0, 0), 1, true);
      },
      std::runtime_error);
}

/// The whole map of a building as bodies of a world, in which a ball flies through a wall.
TEST(VoxelMap, ARealMapIsAWorld) {
  const std::string file = SDF_CCD_TEST_DATA "/octomaps/geb079.bt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const std::string bytes = readText(file);
  const std::size_t at = bytes.find("data\n") + 5;
  VoxelMapOptions options;
  options.band = 0.08;
  VoxelGrid grid(0.08, options);
  grid.addOctree(reinterpret_cast<const std::int8_t*>(bytes.data()) + at, bytes.size() - at, "OcTree", true);
  EXPECT_GE(grid.occupiedCount(), 143729U);  // the number of leaves, some of which are larger than a voxel
  VoxelMap map("map", "world", options);
  const VoxelMap::Change change = map.take(std::move(grid), {});
  EXPECT_GE(change.occupied, 143729U);
  std::size_t bytes_of_fields = 0;
  for (const DistanceField& field : change.fields) bytes_of_fields += field.bytes();
  EXPECT_LT(bytes_of_fields, 100'000'000U);
  RecordProperty("tiles", int(change.made.size()));
  RecordProperty("megabytes", int(bytes_of_fields >> 20));

  SceneDescription description{{body("ball", Primitive(Sphere{0.1}))}, {}};
  description.bodies.insert(description.bodies.end(), change.made.begin(), change.made.end());
  WorldEditor editor(fine(0.02));
  for (std::size_t i = 0; i < change.made.size(); ++i)
    editor.provide(std::get<std::shared_ptr<const TriangleMesh>>(change.made[i].geometry[0].shape), change.fields[i]);
  const auto snapshot = editor.next(description);
  Monitor monitor(snapshot->scene, {});
  // Across the whole map at a height where there are walls.
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  AlignedBox3d box;
  for (const DistanceField& field : change.fields) box.extend(field.box());
  const Vector3d middle = box.center();
  motion.X_WB.assign(description.bodies.size(), still(Isometry3d::Identity()));
  motion.X_WB[0] = {translation({box.min().x(), middle.y(), middle.z()}),
                    translation({box.max().x(), middle.y(), middle.z()})};
  EXPECT_EQ(monitor.run(motion, {}).verdict, Verdict::kContact);
}

}  // namespace
}  // namespace sdf_ccd
