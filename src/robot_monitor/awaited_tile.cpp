#include "robot_monitor/awaited_tile.h"

#include "common/refuse.h"
#include "robot/object_body.h"

namespace sdf_ccd {

BodyDescription awaitedTile(const std::string& frame, const std::string& why) {
  BodyDescription body = emptyWorldBody(std::string(kLiveMap) + "/awaited", frame, Isometry3d::Identity());
  body.map = kLiveMap;
  body.failure = why;
  GeometryDescription voxel;  // represents the voxels to come
  voxel.shape = std::make_shared<const TriangleMesh>(tessellate(Box::fromSize(Vector3d::Constant(0.2)), 0.01));
  voxel.source = body.name;
  voxel.watertight_voxels = true;
  body.geometry.push_back(std::move(voxel));
  return body;
}

void requireNoTile(const std::string& body, const std::string& tiles_begin) {
  if (tiles_begin.empty() || body.rfind(tiles_begin, 0) != 0) return;
  refuse(body + ": names that begin with " + tiles_begin + " are reserved for the live map's tiles");
}

}  // namespace sdf_ccd
