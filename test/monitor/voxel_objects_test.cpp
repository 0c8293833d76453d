#include "monitor/map/voxel_objects.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "monitor/voxel_case.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd::voxel_objects_test {

using namespace test;

/// A box by its middle and half sides, and the exact distance to it from outside.
ObjectMask boxAt(const Vector3d& center, const Vector3d& half, std::uint64_t declared = 1) {
  const AlignedBox3d box(center - half, center + half);
  ObjectMask mask;
  mask.name = "cup";
  mask.declared = declared;
  mask.is_at_stamp = true;
  mask.center_M = center;
  mask.radius = half.norm();
  mask.isWithin = [=](const Vector3d& p, double limit) { return box.exteriorDistance(p) <= limit; };
  return mask;
}

/// By distances voxel by voxel: those within half of their diagonal.
Voxels near(const Voxels& voxels, const Vector3d& center, const Vector3d& half) {
  Voxels found;
  for (const auto& v : voxels) {
    const Vector3d p = kSize * Vector3d(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
    const Vector3d out = ((p - center).cwiseAbs() - half).cwiseMax(0.0);
    if (4.0 * out.squaredNorm() <= 3.0 * kSize * kSize) found.insert(v);
  }
  return found;
}

Voxels minus(Voxels a, const Voxels& b) {
  for (const auto& v : b) a.erase(v);
  return a;
}

Voxels block(int from, int to) {
  Voxels voxels;
  for (int x = from; x < to; ++x)
    for (int y = from; y < to; ++y)
      for (int z = from; z < to; ++z) voxels.insert({x, y, z});
  return voxels;
}

/// A map with one object, and which of its voxels are checked.
class ObjectInMap {
 public:
  void update(const Voxels& occupied, const std::vector<ObjectMask>& objects, const Voxels& free = {}) {
    VoxelMap::Surroundings around;
    around.objects = objects;
    apply(map_.update(gridOf(occupied, {}, free, &map_), around));
  }
  void judge(const std::vector<ObjectMask>& objects) { apply(map_.judgeAgain(objects)); }

  /// What is checked and what is judged as the object, by the surfaces that the tiles have: the voxels behind them.
  std::size_t checked() const { return count(false); }
  std::size_t judged() const { return count(true); }
  bool isIn(const std::array<int, 3>& v, bool of_object) const {
    const Vector3d p = kSize * Vector3d(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
    return std::any_of(tiles_.begin(), tiles_.end(), [&](const auto& tile) {
      return (objects_.count(tile.first) > 0) == of_object && tile.second.geometry[0].field->sample(p).value < 0.0;
    });
  }
  void expect(const Voxels& all, const Voxels& of_object, const std::string& when) const {
    for (const auto& v : all) {
      const bool is_judged = of_object.count(v) > 0;
      EXPECT_EQ(isIn(v, true), is_judged) << when << ": " << v[0] << ' ' << v[1] << ' ' << v[2];
      EXPECT_EQ(isIn(v, false), !is_judged) << when << ": " << v[0] << ' ' << v[1] << ' ' << v[2];
    }
  }

 private:
  void apply(const VoxelMap::Change& change) {
    if (change.made.empty() && change.removed.empty()) return;
    for (const std::string& name : change.removed) EXPECT_EQ(tiles_.erase(name), 1U) << name;
    for (const BodyDescription& made : change.made) tiles_.insert_or_assign(made.name, made);
    objects_ = change.objects;
    for (const auto& [tile, object] : objects_) EXPECT_EQ(tiles_.count(tile), 1U) << tile;
  }
  std::size_t count(bool of_object) const {
    std::size_t n = 0;
    for (const auto& v : block(-12, 12)) n += isIn(v, of_object);
    return n;
  }

  VoxelMap map_{"map", "world", {}};
  std::map<std::string, BodyDescription> tiles_;
  TileObjects objects_;
};

const Vector3d kHalf(0.11, 0.12, 0.13);

TEST(VoxelObjects, VoxelsWithinHalfADiagonalAreJudgedAsTheObject) {
  Random random(5);
  const Voxels all = block(-7, 7);
  for (int i = 0; i < 5; ++i) {
    const Vector3d center = pointInCube(random, 0.1);
    ObjectInMap map;
    map.update(all, {boxAt(center, kHalf)});
    map.expect(all, near(all, center, kHalf), "at once");
    map.update(all, {});
    map.expect(all, {}, "when the object is gone");
  }
}

TEST(VoxelObjects, AnObjectThatIsAddedOrMovedIsJudgedWithTheLastMap) {
  const Voxels all = block(-7, 7);
  const Vector3d moved(0.1, 0.0, 0.0);
  ObjectInMap map;
  map.update(all, {});
  map.judge({boxAt({0, 0, 0}, kHalf)});
  map.expect(all, near(all, {0, 0, 0}, kHalf), "added");
  map.judge({boxAt(moved, kHalf, 2)});
  map.expect(all, near(all, moved, kHalf), "moved by a request");
  map.judge({});
  map.expect(all, {}, "removed");
}

/// What moves, by itself or with the robot, loses voxels at once, and gains none until the next map.
TEST(VoxelObjects, AnObjectThatMovesLeavesItsVoxels) {
  const Voxels all = block(-7, 7);
  const Vector3d moved(0.1, 0.0, 0.0);
  for (const bool is_attached : {false, true}) {
    ObjectMask start = boxAt({0, 0, 0}, kHalf), later = boxAt(moved, kHalf);
    later.is_attached = is_attached;
    const Voxels before = near(all, {0, 0, 0}, kHalf), after = near(all, moved, kHalf);
    const Voxels both = minus(before, minus(before, after));
    ObjectInMap map;
    map.update(all, {start});
    map.judge({later});
    map.expect(all, both, "between maps");
    map.update(all, {later});
    map.expect(all, is_attached ? both : after, "with the next map");
    start.is_attached = is_attached;
    map.judge({start});
    map.expect(all, both, "back again, between maps");
  }
}

/// Otherwise it would free what the robot pushes it into.
TEST(VoxelObjects, AnAttachedObjectThatCreepsIntoTheMapGainsNothing) {
  const Voxels all = block(-7, 7);
  ObjectMask held = boxAt({0, 0, 0.6}, kHalf);
  held.is_attached = true;
  ObjectInMap map;
  for (; held.center_M.z() > 0.0; held = boxAt(held.center_M - Vector3d(0, 0, 0.02), kHalf), held.is_attached = true) {
    map.update(all, {held});
    EXPECT_EQ(map.judged(), 0U) << held.center_M.z();
    EXPECT_EQ(map.checked(), all.size()) << held.center_M.z();
  }
  ObjectInMap later;
  later.update(all, {});
  later.judge({boxAt({0, 0, 0.6}, kHalf)});  // in free space, so that it has no voxels
  held = boxAt({0, 0, 0.3}, kHalf);
  held.is_attached = true;
  later.update(all, {held});
  EXPECT_EQ(later.judged(), 0U);
}

/// By who tracks its pose in the hand: each answer says anew where it is, while the robot pushes it into the map.
TEST(VoxelObjects, WhatIsAttachedAnewGainsNothing) {
  const Voxels all = block(-7, 7);
  const auto heldAt = [](double z, std::uint64_t declared) {
    ObjectMask held = boxAt({0, 0, z}, kHalf, declared);
    held.is_attached = true;
    return held;
  };
  ObjectMask lost = heldAt(0.0, 0);
  lost.isWithin = nullptr;
  for (const bool is_lost : {false, true}) {
    ObjectInMap map;
    map.update(all, {heldAt(0.6, 1)});
    std::uint64_t declared = 1;
    for (double z = 0.58; z > 0.0; z -= 0.02) {
      ++declared;
      lost.declared = declared;
      if (is_lost) map.judge({lost});  // tf does not know yet where it is
      map.judge({heldAt(z, declared)});
      EXPECT_EQ(map.judged(), 0U) << z;
      map.update(all, {heldAt(z, declared)});
      EXPECT_EQ(map.judged(), 0U) << z;
    }
    EXPECT_EQ(map.checked(), all.size());
  }
  // It keeps what it has.
  ObjectInMap grasped;
  grasped.update(all, {boxAt({0, 0, 0}, kHalf)});
  const Voxels had = near(all, {0, 0, 0}, kHalf), there = near(all, {0.05, 0, 0}, kHalf);
  ObjectMask moved = boxAt({0.05, 0, 0}, kHalf);
  moved.is_attached = true;
  grasped.judge({moved});
  moved.declared = 2;
  grasped.judge({moved});
  grasped.expect(all, minus(had, minus(had, there)), "attached anew");
}

TEST(VoxelObjects, WhatIsNotKnownYetGainsLater) {
  const Voxels all = block(-7, 7);
  ObjectMask held = boxAt({0, 0, 0}, kHalf), lost = held;
  held.is_attached = lost.is_attached = true;
  lost.isWithin = nullptr;
  ObjectInMap map;
  map.update(all, {lost});
  EXPECT_EQ(map.judged(), 0U);
  map.judge({held});
  map.expect(all, near(all, {0, 0, 0}, kHalf), "known");
}

TEST(VoxelObjects, WhatTwoObjectsContainIsOneTilesVoxel) {
  const Voxels all = block(-7, 7);
  ObjectMask a = boxAt({0, 0, 0}, kHalf), b = boxAt({0.1, 0, 0}, kHalf);
  b.name = "saucer";
  Voxels both = near(all, {0, 0, 0}, kHalf);
  const Voxels of_b = near(all, {0.1, 0, 0}, kHalf);
  both.insert(of_b.begin(), of_b.end());
  ObjectInMap map;
  map.update(all, {a, b});
  map.expect(all, both, "both");
  map.update(all, {b});
  map.expect(all, of_b, "one");
}

/// Bodies as objects: what is certainly within a distance of them.
TEST(VoxelObjects, TheMasksOfBodiesAreCertain) {
  TriangleMesh bin = boxMesh({0.2, 0.2, 0.2});
  const auto is_lid = [&](const Vector3i& t) {
    return std::min({bin.vertices[t[0]].z(), bin.vertices[t[1]].z(), bin.vertices[t[2]].z()}) > 0.0;
  };
  bin.triangles.erase(std::remove_if(bin.triangles.begin(), bin.triangles.end(), is_lid), bin.triangles.end());
  SceneDescription description{
      {body("box", Primitive(Box::fromSize(2.0 * kHalf)), true), body("mesh", meshShape(boxMesh(kHalf)), true),
       body("bin", meshShape(bin), true), body("floor", Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), true),
       body("ball", Primitive(Sphere{0.05}))},
      {}};
  description.has_live_map = true;
  const auto scene = build(description, fine(0.02));
  const auto maskOfBody = [&](int b) {
    return objectMaskOf(scene->bodies[b], description.bodies[b], Isometry3d::Identity());
  };
  Random random(9);
  for (const int b : {0, 1}) {
    const auto mask = maskOfBody(b);
    ASSERT_TRUE(mask);
    EXPECT_GE(mask->radius, kHalf.norm() - 1e-9);
    EXPECT_LT(mask->radius, kHalf.norm() + 0.05);
    const AlignedBox3d box(-kHalf, kHalf);
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = pointInCube(random, 0.25);
      const double distance = box.exteriorDistance(p);
      if (std::abs(distance - 0.04) < 1e-6) continue;
      EXPECT_EQ(mask->isWithin(p, 0.04), distance < 0.04) << b << ": " << p.transpose();
    }
  }
  const auto open = maskOfBody(2);
  ASSERT_TRUE(open);
  EXPECT_FALSE(open->isWithin({0, 0, 0}, 0.04)) << "what lies in a bin is not the bin";
  EXPECT_TRUE(open->isWithin({0, 0, -0.17}, 0.04));
  EXPECT_FALSE(open->isWithin({0, 0, 0.2}, 0.04)) << "its opening";
  const auto floor = maskOfBody(3);
  ASSERT_TRUE(floor);
  EXPECT_TRUE(floor->isWithin({50.0, 3.0, 0.039}, 0.04));
  EXPECT_FALSE(floor->isWithin({50.0, 3.0, 0.041}, 0.04));
  const Voxels all = block(-2, 2);
  ObjectMask named = *floor;
  named.name = "floor";
  ObjectInMap map;
  map.update(all, {named});
  EXPECT_EQ(map.judged(), 48U) << "three layers: the centres of the third are half a voxel above the floor";
}

}  // namespace sdf_ccd::voxel_objects_test
