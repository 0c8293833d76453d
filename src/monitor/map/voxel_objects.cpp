#include "voxel_objects.h"

#include <cmath>
#include <utility>

#include "sdf_ccd/common/cancel.h"
#include "voxels_near.h"

namespace sdf_ccd {
namespace {

/// Those of the voxels that are in an object.
TileMap voxelsIn(const ObjectMask& object, const TileMap& voxels, double size) {
  const double limit = 0.5 * std::sqrt(3.0) * size;
  TileMap found;
  forTilesNear(voxels, size, object.center_M, object.radius + limit, [&](TileKey key, const TileBits& bits) {
    checkCancelled();
    TileBits in_object;
    visitNear(tileOf(key), size, object.center_M, object.radius + limit, [&](std::size_t i, const Vector3d& p_M) {
      if (bits[i] && object.isWithin(p_M, limit)) in_object.set(i);
    });
    if (in_object.any()) found.emplace(key, in_object);
  });
  return found;
}

TileMap common(const TileMap& a, const TileMap& b) {
  TileMap both;
  for (const auto& [key, bits] : a) {
    const auto other = b.find(key);
    if (other != b.end() && (bits & other->second).any()) both.emplace(key, bits & other->second);
  }
  return both;
}

}  // namespace

bool VoxelObjects::judge(const TileMap& visible, double size, const std::vector<ObjectMask>& objects, bool is_new_map) {
  std::map<std::string, Found> found;
  bool has_changed = false;
  for (const ObjectMask& object : objects) {
    const auto last = found_.find(object.name);
    const bool is_new = isNew(object.name, object.declared);
    const bool may_gain = is_new || (is_new_map && object.is_at_stamp && !object.is_attached);
    Found now{object.declared, voxelsIn(object, may_gain ? visible : common(last->second.voxels, visible), size)};
    has_changed |= is_new ? !now.voxels.empty() || (last != found_.end() && !last->second.voxels.empty())
                          : now.voxels != last->second.voxels;
    found.emplace(object.name, std::move(now));
  }
  for (const auto& [name, last] : found_) has_changed |= found.count(name) == 0 && !last.voxels.empty();
  found_ = std::move(found);
  return has_changed;
}

}  // namespace sdf_ccd
