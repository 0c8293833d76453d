#pragma once

#include <array>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "monitor/map/voxel_map.h"

/// Maps of voxels from lists of indices.
namespace sdf_ccd::test {

constexpr double kSize = 0.05;  // size of a voxel [m]
constexpr int kMiddle = 32768;

using Voxels = std::set<std::array<int, 3>>;  // counted from the origin

/// @param free  known to be free.
/// @param map   that the grid is for; null: none that has anything to remember.
inline VoxelGrid gridOf(const Voxels& voxels, const VoxelMapOptions& options, const Voxels& free = {},
                        const VoxelMap* map = nullptr) {
  VoxelGrid grid(kSize, options);
  if (map) map->watch(grid);
  for (const auto& v : free) grid.add(Vector3i(kMiddle + v[0], kMiddle + v[1], kMiddle + v[2]), 1, false);
  for (const auto& v : voxels) grid.add(Vector3i(kMiddle + v[0], kMiddle + v[1], kMiddle + v[2]), 1, true);
  return grid;
}

/// A map maintained from its changes.
class Kept {
 public:
  void take(const VoxelMap::Change& change) {
    for (const std::string& name : change.removed) ASSERT_EQ(tiles_.erase(name), 1U) << name;
    for (const BodyDescription& made : change.made) tiles_.insert_or_assign(made.name, *made.geometry[0].field);
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

}  // namespace sdf_ccd::test
