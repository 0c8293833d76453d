#include "monitor/map/voxel_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "monitor/voxel_case.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd::voxel_mask_test {

using namespace test;

/// What lies in an open box is not the box.
TEST(VoxelMask, WhatIsInAnOpenBodyCounts) {
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
    kept.take(map.update(gridOf({{0, 0, 0}, {0, 0, 7}, {7, 0, 0}, {0, 0, -8}, {3, 7, 2}}, options), {{*mask}}));
    EXPECT_LT(kept.distance({0.025, 0.025, 0.025}), 0.0) << "in its middle";
    EXPECT_LT(kept.distance({0.025, 0.025, 0.375}), 0.0) << "in its opening";
    EXPECT_GT(kept.distance({0.375, 0.025, 0.025}), 0.0) << "a wall";
    EXPECT_GT(kept.distance({0.025, 0.025, -0.375}), 0.0) << "the floor";
    EXPECT_GT(kept.distance({0.175, 0.375, 0.125}), 0.0) << "a wall";
    EXPECT_GT(kept.distance({0.2, 0.2, -0.2}), 0.0) << "unknown space inside";
  }
}

/// A ring, and what tells how far points are from it.
constexpr double kRing = 0.4, kTube = 0.08;

double distanceToRing(const Vector3d& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - kRing, p.z()) - kTube;
}

BodyDescription ring() {
  return body("ring", meshShape(torusMesh(kRing, kTube, 96, 48)));
}

/// What stands for the tiles of a map that has not come.
BodyDescription awaitedTile() {
  BodyDescription awaited = body("map/awaited", meshShape(boxMesh({0.1, 0.1, 0.1})), true);
  awaited.map = "map";
  awaited.failure = "no map yet";
  awaited.geometry.front().watertight_voxels = true;
  return awaited;
}

SceneDescription besideAMap(std::vector<BodyDescription> bodies) {
  bodies.push_back(awaitedTile());
  SceneDescription description{std::move(bodies), {}};
  description.has_live_map = true;
  return description;
}

/// The ring's mask, and what that refers to.
struct RingBesideAMap {
  explicit RingBesideAMap(const BodyOptions& options) : scene(build(description, options)) {}

  SceneDescription description = besideAMap({ring()});
  std::shared_ptr<const Scene> scene;
  std::optional<VoxelMask> mask = maskOf(scene->bodies[0], description.bodies[0], Isometry3d::Identity());
};

/// Whether the mask hides exactly what is within the padding of the ring; of 400 voxels around it.
/// @param error  of the fields: as far from the surface, either answer is right [m].
void expectHidden(const VoxelMask& mask, double error) {
  const VoxelMapOptions options;
  const double pad = options.padding + 0.5 * kSize;
  constexpr double kChords = 0.001;  // between the ring and its triangles [m]
  Random random(3);
  int hidden = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Array3i v = (10.0 * uniform(random, 0.0, 1.3) * direction(random).array()).cast<int>();
    const double distance = distanceToRing(kSize * (v.cast<double>() + 0.5).matrix());
    VoxelMap map("map", "world", options);
    const std::size_t masked = map.update(gridOf({{v.x(), v.y(), v.z()}}, options), {{mask}}).masked;
    if (distance < pad - kChords) {
      EXPECT_EQ(masked, 1U) << distance;
    } else if (distance > std::max(pad, error) + kChords) {
      EXPECT_EQ(masked, 0U) << distance;
    }
    hidden += static_cast<int>(masked);
  }
  EXPECT_GT(hidden, 30);
}

/// In cells without samples, and beside large leaves, the error of a sample is larger than its value.
TEST(VoxelMask, NoFieldHidesVoxelsBeyondThePadding) {
  FieldOptions coarse, fine_cells, loose, close;
  coarse.cells = 32;
  fine_cells.cells = 100;
  loose.max_error = 0.03;
  close.max_error = 0.002;
  for (const FieldOptions& field : {coarse, fine_cells, loose, close}) {
    BodyOptions options = fine();
    options.field = field;
    const RingBesideAMap ring(options);
    ASSERT_TRUE(ring.mask);
    expectHidden(*ring.mask, maskError(*ring.scene));
  }
  const RingBesideAMap ring(optionsForContacts());
  ASSERT_TRUE(ring.mask);
  expectHidden(*ring.mask, maskError(*ring.scene));
}

/// Two slabs with a jaw of 20 cm between them, with the options of the node.
TEST(VoxelMask, WhatIsInAJawCounts) {
  TriangleMesh jaw = boxMesh({0.01, 0.12, 0.2});
  for (Vector3d& p : jaw.vertices) p.x() -= 0.2;
  for (const double y : {-0.11, 0.11}) jaw = merged(std::move(jaw), translated(boxMesh({0.2, 0.01, 0.2}), {0, y, 0}));
  const SceneDescription description = besideAMap({body("gripper", meshShape(jaw))});
  const auto scene = build(description, optionsForContacts());
  const VoxelMapOptions options;
  for (const Vector3d& p : {Vector3d(0.0732, 0, 0.1779), Vector3d(0.06, 0, 0.16), Vector3d(0.1, 0, 0.1)}) {
    // The voxel's centre is at the point.
    const Vector3d center = Vector3d::Constant(0.5 * kSize);
    const auto mask = maskOf(scene->bodies[0], description.bodies[0], Isometry3d(Eigen::Translation3d(p - center)));
    ASSERT_TRUE(mask);
    VoxelMap map("map", "world", options);
    EXPECT_EQ(map.update(gridOf({{0, 0, 0}}, options), {{*mask}}).masked, 0U) << p.transpose();
  }
}

/// An object that is attached while a map is empty: nothing says that a map will come.
TEST(VoxelMask, ABodyWithoutItsSurfaceHidesNoMore) {
  const SceneDescription description{{ring(), body("table", Primitive(Box::fromSize({0.2, 0.2, 0.2})), true)}, {}};
  const auto scene = build(description, optionsForContacts());
  ASSERT_FALSE(scene->bodies[0].surface);
  const auto mask = maskOf(scene->bodies[0], description.bodies[0], Isometry3d::Identity());
  ASSERT_TRUE(mask);
  expectHidden(*mask, maskError(*scene));
}

TEST(VoxelMask, HidesUnknownSpaceAsOccupiedSpace) {
  const RingBesideAMap ring(optionsForContacts());
  ASSERT_TRUE(ring.mask);
  VoxelMapOptions unknown;
  unknown.unknown = UnknownSpace::kOccupied;
  VoxelMap map("map", "world", unknown);
  Kept kept;
  kept.take(map.update(gridOf({{-12, -12, -12}, {12, 12, 12}}, unknown), {{*ring.mask}}));
  EXPECT_LT(kept.distance(Vector3d::Constant(0.025)), 0.0) << "unknown space within the ring";
  EXPECT_GT(kept.distance({kRing, 0.0, 0.0}), 0.0) << "unknown space in the ring's tube";
}

/// A field's lower bound is loose far from the surface.
TEST(VoxelMask, UnknownSpaceFarFromABodyIsNotNearIt) {
  const RingBesideAMap ring(optionsForContacts());
  ASSERT_TRUE(ring.mask);
  VoxelMapOptions options;
  options.unknown = UnknownSpace::kOccupiedNear;
  options.near_distance = 0.2;
  for (const auto& [key, bits] : gridOf({}, options).occupied({*ring.mask}).tiles) {
    for (std::size_t i = 0; i < bits.size(); ++i) {
      if (!bits[i]) continue;
      const auto k = static_cast<int>(i);
      const Vector3i voxel =
          kTileSide * tileOf(key) + Vector3i(k % kTileSide, k / kTileSide % kTileSide, k / kTileSide / kTileSide);
      EXPECT_LT(distanceToRing(cornerOf(voxel, kSize) + Vector3d::Constant(0.5 * kSize)), 0.203) << voxel.transpose();
    }
  }
}

}  // namespace sdf_ccd::voxel_mask_test
