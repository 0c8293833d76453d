#include "voxel_objects.h"

#include <cmath>
#include <utility>

#include "common/cancel_point.h"
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
  static const TileMap kNone;
  std::map<std::string, Found> found;
  bool has_changed = false;
  for (const ObjectMask& object : objects) {
    const auto last = found_.find(object.name);
    const bool was_attached = last != found_.end() && last->second.is_attached;
    const bool is_new = isNew(object.name, object.declared);
    const TileMap& had = last == found_.end() ? kNone : last->second.voxels;
    Found now{object.declared, object.is_attached, {}};
    if (!object.isWithin) {
      if (last == found_.end()) continue;
      now.declared = last->second.declared;
    } else if (is_new ? !(was_attached && object.is_attached)
                      : is_new_map && object.is_at_stamp && !object.is_attached) {
      now.voxels = voxelsIn(object, visible, size);
    } else {
      now.voxels = voxelsIn(object, common(had, visible), size);
    }
    has_changed |= is_new ? !now.voxels.empty() || !had.empty() : now.voxels != had;
    found.emplace(object.name, std::move(now));
  }
  for (const auto& [name, last] : found_) has_changed |= found.count(name) == 0 && !last.voxels.empty();
  found_ = std::move(found);
  return has_changed;
}

}  // namespace sdf_ccd
