#include "monitor/map/voxel_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "monitor/voxel_case.h"
#include "oracle/random.h"

namespace sdf_ccd::voxel_memory_test {

using namespace test;

using Voxel = std::array<int, 3>;

VoxelMask ball(const Vector3d& center, double radius) {
  VoxelMask mask;
  mask.center_M = center;
  mask.radius = radius;
  mask.distance = [=](const Vector3d& p) { return (p - center).norm() - radius; };
  return mask;
}

Vector3d centerOf(const Voxel& v) {
  return kSize * Vector3d(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
}

Voxels voxelsOf(const TileMap& tiles) {
  Voxels voxels;
  for (const auto& [key, bits] : tiles)
    for (int i = 0; i < int(bits.size()); ++i) {
      if (!bits[i]) continue;
      const Vector3i v = (kTileSide * tileOf(key)).array() - kMiddle;
      voxels.insert({v.x() + i % kTileSide, v.y() + i / kTileSide % kTileSide, v.z() + i / kTileSide / kTileSide});
    }
  return voxels;
}

/// A map of cubes of voxels, as octrees have them; what it does not list is unknown.
struct Leaf {
  Voxel low;
  int side;
  bool is_occupied;

  bool contains(const Voxel& v) const {
    for (int k = 0; k < 3; ++k)
      if (v[k] < low[k] || v[k] >= low[k] + side) return false;
    return true;
  }
};
using Leaves = std::vector<Leaf>;

Leaves leavesOf(const Voxels& voxels, bool is_occupied = true) {
  Leaves leaves;
  for (const Voxel& v : voxels) leaves.push_back({v, 1, is_occupied});
  return leaves;
}

Leaves operator+(Leaves a, const Leaves& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A robot of balls in a map that changes.
class Watched {
 public:
  explicit Watched(const VoxelMapOptions& options = {}) : options_(options), memory_(options.max_tiles) {}

  VoxelMemory::Seen see(const Leaves& leaves, const std::vector<VoxelMask>& masks, bool is_known = true,
                        bool is_again = false) {
    VoxelGrid grid(kSize, options_);
    memory_.watch(grid);
    for (const Leaf& leaf : leaves)
      grid.add(Vector3i(leaf.low[0], leaf.low[1], leaf.low[2]).array() + kMiddle, leaf.side, leaf.is_occupied);
    VoxelMemory::Seen seen = memory_.see(grid, masks, is_known, is_again);
    memory_.accept(seen.after, is_again);
    return seen;
  }
  void forget() { memory_.forget(); }

 private:
  VoxelMapOptions options_;
  VoxelMemory memory_;
};

Voxels table() {
  Voxels voxels;
  for (int x = -4; x < 4; ++x)
    for (int y = -4; y < 4; ++y)
      for (int z = -4; z < 0; ++z) voxels.insert({x, y, z});
  return voxels;
}

/// However slowly: the padding is 3 cm, a map comes every millimetre.
TEST(VoxelMemory, WhatWasThereBeforeTheRobotStaysAnObstacle) {
  Watched map;
  for (double z = 0.3; z > -0.1; z -= 0.001)
    EXPECT_EQ(voxelsOf(map.see(leavesOf(table()), {ball({0.0, 0.0, z}, 0.05)}).tiles), table()) << z;
}

TEST(VoxelMemory, OnlyWhatAMapShowsAsFreeIsGone) {
  Watched map;
  map.see(leavesOf(table()), {});
  const std::vector<VoxelMask> robot = {ball({0.0, 0.0, 0.0}, 0.1)};
  EXPECT_EQ(voxelsOf(map.see({}, robot).tiles), table()) << "unknown now";
  const Voxel top{0, 0, -1};
  Voxels left = table();
  left.erase(top);
  EXPECT_EQ(voxelsOf(map.see({{top, 1, false}}, robot).tiles), left);
  EXPECT_EQ(voxelsOf(map.see(leavesOf(table()), robot).tiles), left) << "it became occupied beside the robot";
  EXPECT_EQ(voxelsOf(map.see(leavesOf(table()), {}).tiles), table()) << "and is occupied without it";
  EXPECT_TRUE(map.see({{{-4096, -4096, -4096}, 8192, false}}, {}).tiles.empty()) << "a large leaf";
}

TEST(VoxelMemory, WhatBecomesOccupiedBesideTheRobotIsItsPicture) {
  Watched map;
  const Voxels picture = {{10, 0, 0}, {10, 1, 0}};
  const std::vector<VoxelMask> robot = {ball(centerOf({10, 0, 0}), 0.1)};
  map.see(leavesOf(table()), robot);
  const VoxelMemory::Seen seen = map.see(leavesOf(table()) + leavesOf(picture), robot);
  EXPECT_EQ(voxelsOf(seen.tiles), table());
  EXPECT_EQ(seen.masked, 2U);
  EXPECT_EQ(seen.unproven, 0U);
}

TEST(VoxelMemory, InTheFirstMapNothingIsProven) {
  Watched map;
  const std::vector<VoxelMask> robot = {ball({0.0, 0.0, 0.0}, 0.1)}, away = {ball({0.0, 0.0, 1.0}, 0.1)};
  for (int i = 0; i < 3; ++i) {
    const VoxelMemory::Seen seen = map.see(leavesOf(table()), robot);
    EXPECT_GT(seen.masked, 0U);
    EXPECT_EQ(seen.unproven, seen.masked);
    EXPECT_EQ(voxelsOf(seen.tiles).size(), table().size() - seen.masked);
  }
  EXPECT_EQ(map.see(leavesOf(table()), away).unproven, 0U);
  EXPECT_EQ(map.see(leavesOf(table()), robot).masked, 0U) << "now it is known to be an obstacle";
  map.forget();
  EXPECT_GT(map.see(leavesOf(table()), robot).unproven, 0U);
}

TEST(VoxelMemory, WhereTheRobotMayHaveBeenNothingIsRemembered) {
  Watched map;
  VoxelMask guess = ball({0.0, 0.0, 0.0}, 0.1);
  guess.only_unknown = guess.is_guess = true;
  EXPECT_EQ(voxelsOf(map.see(leavesOf(table()), {guess}).tiles), table()) << "all of it counts";
  const std::vector<VoxelMask> robot = {ball({0.0, 0.0, 0.0}, 0.1)};
  const VoxelMemory::Seen known = map.see(leavesOf(table()), robot, true, true);
  EXPECT_GT(known.masked, 0U);
  EXPECT_EQ(known.unproven, known.masked) << "it may be the robot's or an obstacle";

  Watched lost;  // some body may be anywhere
  EXPECT_EQ(voxelsOf(lost.see(leavesOf(table()), {}, false).tiles), table());
  EXPECT_GT(lost.see(leavesOf(table()), robot).masked, 0U);
}

/// A later look at the same map is not a later map.
TEST(VoxelMemory, AMapThatIsSeenAgainIsThatMap) {
  Watched map;
  map.see({{{0, 0, 0}, 1, false}}, {});
  const Leaves leaves = leavesOf({{0, 0, 0}});
  EXPECT_EQ(voxelsOf(map.see(leaves, {}).tiles).size(), 1U);
  EXPECT_EQ(map.see(leaves, {ball(centerOf({0, 0, 0}), 0.1)}, true, true).masked, 1U);
}

TEST(VoxelMemory, KeepsNoMoreThanAMapMayHave) {
  VoxelMapOptions options;
  options.max_tiles = 100;
  Watched map(options);
  std::size_t forgotten = 0;
  for (int i = 0; i < 300; ++i) {  // a window that moves along
    const Voxel v{100 * i, 0, 0};
    const VoxelMemory::Seen seen = map.see({{v, 1, true}}, {ball(centerOf(v) + Vector3d(0, 0, 1), 0.1)});
    forgotten += seen.forgotten;
    EXPECT_LE(seen.tiles.size(), 51U);
    for (int near = std::max(0, i - 10); near <= i; ++near)
      EXPECT_EQ(voxelsOf(seen.tiles).count({100 * near, 0, 0}), 1U) << i;
  }
  EXPECT_EQ(forgotten, 300U - 50U);
}

/// The rule, voxel by voxel.
class SlowMemory {
 public:
  explicit SlowMemory(const VoxelMapOptions& options) : options_(options) {}

  /// @return the voxels of a region that count.
  Voxels see(const Leaves& leaves, const std::vector<VoxelMask>& masks, int from, int to) {
    Voxels counts;
    unproven = 0;
    for (int x = from; x < to; ++x)
      for (int y = from; y < to; ++y)
        for (int z = from; z < to; ++z) {
          const Voxel v{x, y, z};
          bool is_occupied = false, is_free = false;
          for (const Leaf& leaf : leaves)
            if (leaf.contains(v)) (leaf.is_occupied ? is_occupied : is_free) = true;
          const bool is_beside = std::any_of(masks.begin(), masks.end(), [&](const VoxelMask& mask) {
            return mask.distance(centerOf(v)) <= options_.padding + 0.5 * kSize;
          });
          State& state = states_[v];
          if (is_free) state = State::kUnseen;
          if (is_occupied && !is_beside) state = State::kObstacle;
          if (is_occupied && is_beside && is_first_ && state == State::kUnseen) state = State::kUnproven;
          if (state == State::kObstacle) counts.insert(v);
          if (state == State::kUnproven && is_occupied && is_beside) ++unproven;
        }
    is_first_ = false;
    return counts;
  }
  std::size_t unproven = 0;

 private:
  enum class State { kUnseen, kObstacle, kUnproven };
  VoxelMapOptions options_;
  std::map<Voxel, State> states_;
  bool is_first_ = true;
};

TEST(VoxelMemory, EqualsTheRuleVoxelByVoxel) {
  Random random(11);
  const auto index = [&](int from, int to) { return int(std::floor(uniform(random, from, to))); };
  for (int run = 0; run < 12; ++run) {
    VoxelMapOptions options;
    options.padding = uniform(random, 0.0, 0.08);
    options.unknown = run % 2 == 0 ? UnknownSpace::kFree : UnknownSpace::kOccupiedNear;
    options.near_distance = 0.0;  // what is known is kept, but no unknown voxel counts
    Watched map(options);
    SlowMemory slow(options);
    Vector3d p(0.0, 0.0, 0.3);
    for (int scan = 0; scan < 15; ++scan) {
      Leaves leaves;
      std::map<Voxel, bool> blocks;  // leaves do not overlap
      for (int i = 0; i < 60; ++i) blocks[{index(-5, 5), index(-5, 5), index(-5, 5)}] = uniform(random, 0, 1) < 0.5;
      for (const auto& [block, is_occupied] : blocks) {
        const Voxel low{2 * block[0], 2 * block[1], 2 * block[2]};
        if (uniform(random, 0, 1) < 0.5) {
          leaves.push_back({low, 2, is_occupied});
        } else {
          for (int i = 0; i < 8; ++i)
            if (uniform(random, 0, 1) < 0.7)
              leaves.push_back(
                  {{low[0] + (i & 1), low[1] + (i >> 1 & 1), low[2] + (i >> 2)}, 1, uniform(random, 0, 1) < 0.5});
        }
      }
      p += 0.05 * direction(random);
      const std::vector<VoxelMask> masks = {ball(p, 0.12), ball(-p, 0.05)};
      const VoxelMemory::Seen seen = map.see(leaves, masks);
      const Voxels all = voxelsOf(seen.tiles), expected = slow.see(leaves, masks, -12, 12);
      EXPECT_EQ(all, expected) << run << ' ' << scan;
      EXPECT_EQ(seen.unproven, slow.unproven) << run << ' ' << scan;
    }
  }
}

}  // namespace sdf_ccd::voxel_memory_test
