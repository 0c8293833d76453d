#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "monitor/voxel_case.h"
#include "oracle/random.h"

namespace sdf_ccd::voxel_layers_test {

using namespace test;

using Voxel = std::array<int, 3>;

constexpr int kFrom = -4, kTo = 5;  // voxels that may be occupied; tiles meet at 0 - 32768 % 18 = -8 and 10
constexpr int kShift = 9;           // so that the middle is where eight tiles meet

Vector3d centerOf(const Voxel& v) {
  return kSize * Vector3d(v[0] + 0.5, v[1] + 0.5, v[2] + 0.5);
}

/// A box, and what a request or a hand has done with it.
struct Thing {
  std::string name;
  AlignedBox3d box;
  std::uint64_t declared = 1;
  bool is_attached = false, is_at_stamp = true, is_known = true;

  bool contains(const Voxel& v) const { return box.exteriorDistance(centerOf(v)) <= 0.5 * std::sqrt(3.0) * kSize; }
  ObjectMask mask() const {
    ObjectMask mask;
    mask.name = name;
    mask.declared = declared;
    mask.is_attached = is_attached;
    mask.is_at_stamp = is_at_stamp;
    mask.center_M = box.center();
    mask.radius = 0.5 * box.diagonal().norm();
    if (is_known) mask.isWithin = [b = box](const Vector3d& p, double limit) { return b.exteriorDistance(p) <= limit; };
    return mask;
  }
};

/// The rules, voxel by voxel: what is an obstacle, and as what it is judged.
class SlowLayers {
 public:
  explicit SlowLayers(double padding) : padding_(padding) {}

  void see(const Voxels& occupied, const Voxels& free, const Vector3d& robot, double radius) {
    for (const Voxel& v : free) obstacles_.erase(v);
    for (const Voxel& v : occupied)
      if ((centerOf(v) - robot).norm() - radius > padding_ + 0.5 * kSize) obstacles_.insert(v);
  }
  void judge(const std::vector<Thing>& things, bool is_new_map) {
    std::map<std::string, Judged> now;
    for (const Thing& thing : things) {
      const auto last = judged_.find(thing.name);
      const bool is_new = last == judged_.end() || last->second.declared != thing.declared;
      const bool was_attached = last != judged_.end() && last->second.is_attached;
      Judged& made = now[thing.name];
      made.declared = thing.declared;
      made.is_attached = thing.is_attached;
      if (!thing.is_known) {
        if (last == judged_.end()) {
          now.erase(thing.name);
        } else {
          made.declared = last->second.declared;
        }
        continue;
      }
      bool may_gain = is_new_map && thing.is_at_stamp && !thing.is_attached;
      if (is_new) may_gain = !thing.is_attached || !was_attached;
      for (const Voxel& v : obstacles_)
        if (thing.contains(v) && (may_gain || (last != judged_.end() && last->second.voxels.count(v) > 0)))
          made.voxels.insert(v);
    }
    judged_ = now;
  }
  /// Of whom a voxel is: "" the map's, "-" nobody's.
  std::string ownerOf(const Voxel& v) const {
    if (obstacles_.count(v) == 0) return "-";
    for (const auto& [name, judged] : judged_)
      if (judged.voxels.count(v) > 0) return name;
    return "";
  }

 private:
  struct Judged {
    std::uint64_t declared = 0;
    bool is_attached = false;
    Voxels voxels;
  };
  double padding_;
  Voxels obstacles_;
  std::map<std::string, Judged> judged_;
};

/// The tiles that a map has made so far.
class Tiles {
 public:
  void take(VoxelMap::Change& change) {
    for (const std::string& name : change.removed) ASSERT_EQ(tiles_.erase(name), 1u) << name;
    for (BodyDescription& tile : change.made) tiles_.insert_or_assign(tile.name, *tile.geometry[0].field);
    if (!change.made.empty() || !change.removed.empty()) objects_ = change.objects;
  }
  std::string ownerOf(const Voxel& v) const {
    std::set<std::string> owners;
    for (const auto& [name, field] : tiles_) {
      const auto object = objects_.find(name);
      if (field.sample(centerOf(v)).value < 0.0) owners.insert(object == objects_.end() ? "" : object->second.object);
    }
    return owners.empty() ? "-" : owners.size() == 1 ? *owners.begin() : "several";
  }

 private:
  std::map<std::string, DistanceField> tiles_;
  TileObjects objects_;
};

TEST(VoxelLayers, EqualTheRulesVoxelByVoxel) {
  for (unsigned run = 0; run < 6; ++run) {
    Random random(100 + run);
    const auto chance = [&](double p) { return uniform(random, 0, 1) < p; };
    VoxelMapOptions options;
    options.padding = uniform(random, 0.0, 0.06);
    VoxelMap map("map", "world", options);
    SlowLayers slow(options.padding);
    Tiles tiles;
    std::vector<Thing> things;
    Vector3d robot(0.45, 0.45, 0.8);
    std::uint64_t declared = 1;
    for (int step = 0; step < 25; ++step) {
      for (Thing& thing : things) {
        if (chance(0.5)) thing.box.translate(Vector3d(0.04 * direction(random)));
        if (chance(0.15)) thing.declared = ++declared;
        if (chance(0.15)) thing.is_attached = !thing.is_attached;
        thing.is_at_stamp = chance(0.8);
        thing.is_known = !thing.is_attached || chance(0.8);
      }
      if (chance(0.2) && !things.empty()) things.erase(things.begin());
      if (chance(0.4) && things.size() < 3) {
        const Vector3d half(uniform(random, 0.02, 0.12), uniform(random, 0.02, 0.12), uniform(random, 0.02, 0.12));
        const Vector3d center = Vector3d::Constant(0.45) + 0.2 * direction(random);
        things.push_back({std::string(1, char('a' + step)), AlignedBox3d(center - half, center + half), ++declared});
      }
      std::vector<ObjectMask> masks;
      for (const Thing& thing : things) masks.push_back(thing.mask());
      if (step > 0 && chance(0.4)) {
        VoxelMap::Change change = map.judgeAgain(masks);
        tiles.take(change);
        slow.judge(things, false);
      } else {
        Voxels occupied, free;
        for (int x = kFrom; x < kTo; ++x)
          for (int y = kFrom; y < kTo; ++y)
            for (int z = kFrom; z < kTo; ++z) {
              const Voxel v{x + kShift, y + kShift, z + kShift};
              if (chance(0.3)) (chance(0.6) ? occupied : free).insert(v);
            }
        robot += 0.04 * direction(random);
        VoxelMap::Surroundings around;
        around.objects = masks;
        VoxelMask mask;
        mask.center_M = robot;
        mask.radius = 0.1;
        mask.distance = [=](const Vector3d& p) { return (p - robot).norm() - 0.1; };
        around.masks = {mask};
        VoxelMap::Change change = map.update(gridOf(occupied, options, free, &map), around);
        tiles.take(change);
        slow.see(occupied, free, robot, 0.1);
        slow.judge(things, true);
      }
      for (int x = kFrom - 1; x <= kTo; ++x)
        for (int y = kFrom - 1; y <= kTo; ++y)
          for (int z = kFrom - 1; z <= kTo; ++z) {
            const Voxel v{x + kShift, y + kShift, z + kShift};
            ASSERT_EQ(tiles.ownerOf(v), slow.ownerOf(v))
                << run << ' ' << step << ": " << v[0] << ' ' << v[1] << ' ' << v[2];
          }
    }
  }
}

}  // namespace sdf_ccd::voxel_layers_test
