#include "ros/world/world_bodies.h"

#include "robot/object_body.h"
#include "ros/parameters/moveit_scene.h"
#include "scene/pair_rules.h"

namespace sdf_ccd {

std::string whyNoName(const std::string& name) {
  if (!isSavedName(name))
    return "object '" + name + "': a name must not be empty, begin or end with a blank, or contain control characters";
  if (isPattern(name)) return "object " + name + ": a name must not contain * or ?, which are wildcards in patterns";
  return {};
}

BodyDescription awaitedTile(const std::string& frame, const std::string& why) {
  BodyDescription body =
      emptyWorldBody(std::string(LiveMapParameters::kName) + "/awaited", frame, Isometry3d::Identity());
  body.map = LiveMapParameters::kName;
  body.failure = why;
  GeometryDescription voxel;  // represents the voxels to come
  voxel.shape = std::make_shared<const TriangleMesh>(tessellate(Box::fromSize(Vector3d::Constant(0.2)), 0.01));
  voxel.source = body.name;
  voxel.watertight_voxels = true;
  body.geometry.push_back(std::move(voxel));
  return body;
}

}  // namespace sdf_ccd
