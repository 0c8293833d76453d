#include "ros/world/world_bodies.h"

#include <stdexcept>

#include "model/pair_rules.h"
#include "robot/object_body.h"
#include "ros/parameters/moveit_scene.h"
#include "sdf_ccd/import/mesh_file.h"

namespace sdf_ccd {
std::string whyNoName(const std::string& name) {
  if (!isSavedName(name))
    return "object '" + name + "': a name must not be empty, begin or end with a blank, or contain control characters";
  if (isPattern(name)) return "object " + name + ": a name must not contain * or ?, which are wildcards in patterns";
  return {};
}

BodyDescription toBody(const std::string& name, const OctomapObject& octomap, const std::string& frame,
                       const ResourceLoader& loader) {
  BodyDescription body = emptyWorldBody(name, frame, octomap.X_frame_B);
  try {
    double resolution = 0.0;
    GeometryDescription geometry;
    const Resource file = loader(octomap.file);
    geometry.shape = std::make_shared<const TriangleMesh>(parseOctomapSurface(file.bytes, file.name, resolution));
    geometry.source = file.name;
    geometry.watertight_voxels = true;
    // The field's error, √3/2 of a cell, is then less than the depth at the centre of a single voxel: no voxel is
    // lost.
    geometry.cell_size = octomap.cell_size > 0.0 ? octomap.cell_size : 0.5 * resolution;
    body.geometry.push_back(std::move(geometry));
  } catch (const std::exception& error) {
    body.failure = error.what();
  }
  return body;
}

BodyDescription awaitedTile(const std::string& frame, const std::string& why) {
  BodyDescription body =
      emptyWorldBody(std::string(LiveMapParameters::kName) + "/awaited", frame, Isometry3d::Identity());
  body.map = LiveMapParameters::kName;
  body.failure = why;
  GeometryDescription voxel;  // represents the voxels to come
  voxel.shape = std::make_shared<const TriangleMesh>(tessellate(Box{Vector3d::Constant(0.1)}, 0.01));
  voxel.source = body.name;
  voxel.watertight_voxels = true;
  body.geometry.push_back(std::move(voxel));
  return body;
}

}  // namespace sdf_ccd
