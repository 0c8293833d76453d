#include "monitor/map/voxel_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "monitor/voxel_case.h"
#include "oracle/files.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/test_data.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::voxel_map_test {

using namespace test;

VoxelMask ballMask(const Vector3d& center, double radius) {
  VoxelMask mask;
  mask.center_M = center;
  mask.radius = radius;
  mask.distance = [=](const Vector3d& p) { return (p - center).norm() - radius; };
  return mask;
}

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
    Voxels freed;
    for (int i = 0; i < (scan == 0 ? 0 : 30); ++i) {
      const std::array<int, 3> v{int(uniform(random, -30, 30)), int(uniform(random, -30, 30)),
                                 int(uniform(random, -6, 20))};
      if (voxels.erase(v)) {
        freed.insert(v);
      } else {
        voxels.insert(v);
        freed.erase(v);
      }
      ++changed;
    }
    const VoxelMap::Change change = map.update(gridOf(voxels, options, freed, &map), {});
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
    EXPECT_TRUE(map.update(gridOf(voxels, options), {}).made.empty()) << "nothing has changed";
  }
  const VoxelMap::Change gone = map.update(gridOf({}, options, voxels, &map), {});
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
  kept.take(map.update(gridOf(voxels, {}), {}));
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
  const VoxelMap::Change change = map.update(gridOf(voxels, options), {{ball}});
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
  kept.take(map.update(gridOf(voxels, options), {}));
  EXPECT_LT(kept.distance(ball.center_M), 0.0);
}

/// However long a link is beside the voxels.
TEST(VoxelMap, AMaskTakesNoMoreThanTheTilesThereAre) {
  VoxelMapOptions options;
  options.max_tiles = 2;
  VoxelMap map("map", "world", options);
  const VoxelMask ball = ballMask({0.1, 0.0, 0.0}, 20.0), far = ballMask({0.0, 0.0, 1000.0}, 500.0);
  EXPECT_EQ(map.update(gridOf({{0, 0, 0}, {5, 0, 0}}, options), {{far}}).masked, 0U);
  map.forget();  // else they are known to be obstacles
  EXPECT_EQ(map.update(gridOf({{0, 0, 0}, {5, 0, 0}}, options), {{ball, far}}).masked, 2U);
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
  kept.take(all.update(gridOfFree(), {}));
  EXPECT_GT(kept.distance({0.4, 0.4, 0.4}), 0.1);
  EXPECT_LT(kept.distance({1.2, 0.4, 0.4}), 0.0);

  options.unknown = UnknownSpace::kOccupiedNear;
  options.near_distance = 0.3;
  const VoxelMask ball = ballMask({0.75, 0.4, 0.4}, 0.1);
  VoxelMap near("map", "world", options);
  Kept kept_near;
  kept_near.take(near.update(gridOfFree(), {{ball}}));
  EXPECT_GT(kept_near.distance({0.4, 0.4, 0.4}), 0.1);
  EXPECT_LT(kept_near.distance({1.05, 0.4, 0.4}), 0.0);  // unknown, 0.2 m from the ball
  EXPECT_GT(kept_near.distance({1.5, 0.4, 0.4}), 0.2);   // unknown, but far away

  options.max_tiles = 150;  // fewer than the bounding box of what is near has
  VoxelMask rod = ballMask(Vector3d::Zero(), 5.0);
  rod.distance = [](const Vector3d& p) { return std::hypot(std::max(std::abs(p.x()) - 5.0, 0.0), p.y(), p.z()); };
  VoxelMap along("map", "world", options);
  EXPECT_NO_THROW(along.update(VoxelGrid(kSize, options), {{rod}}));
  rod.distance = [](const Vector3d& p) { return p.norm() - 5.0; };
  EXPECT_THROW(along.update(VoxelGrid(kSize, options), {{rod}}), std::runtime_error);
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
  kept.take(map.update(std::move(grid), {{ball}}));
  EXPECT_LT(kept.distance(p), 0.0);
  EXPECT_GT(kept.distance(p + Vector3d(0.1, 0.0, 0.0)), 0.0);  // unknown, and filled by the ball
  EXPECT_LT(kept.distance(p + Vector3d(0.3, 0.0, 0.0)), 0.0);  // unknown, near the ball
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
    kept.take(map.update(std::move(grid), {{ballMask({20.0, 20.0, 25.0}, 0.1), ballMask({51.1, 51.1, 25.0}, 0.1)}}));
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
  const VoxelMap::Change change = map.update(std::move(grid), {});
  EXPECT_GE(change.occupied, 143729U);
  std::size_t bytes_of_fields = 0;
  for (const BodyDescription& tile : change.made) bytes_of_fields += tile.geometry[0].field->bytes();
  EXPECT_LT(bytes_of_fields, 100'000'000U);
  RecordProperty("tiles", int(change.made.size()));
  RecordProperty("megabytes", int(bytes_of_fields >> 20));

  SceneDescription description{{body("ball", Primitive(Sphere{0.1}))}, {}};
  description.bodies.insert(description.bodies.end(), change.made.begin(), change.made.end());
  WorldEditor editor(fine(0.02));
  const auto snapshot = editor.next(description);
  Monitor monitor(snapshot->scene, {});
  // Across the whole map at a height where there are walls.
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  AlignedBox3d box;
  for (const BodyDescription& tile : change.made) box.extend(tile.geometry[0].field->box());
  const Vector3d middle = box.center();
  motion.X_WB.assign(description.bodies.size(), still(Isometry3d::Identity()));
  motion.X_WB[0] = {translation({box.min().x(), middle.y(), middle.z()}),
                    translation({box.max().x(), middle.y(), middle.z()})};
  EXPECT_EQ(monitor.run(motion, {}).verdict, Verdict::kContact);
}

}  // namespace sdf_ccd::voxel_map_test
