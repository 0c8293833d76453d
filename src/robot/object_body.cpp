#include "object_body.h"

#include <array>
#include <stdexcept>

#include "robot/moveit_scene.h"
#include "scene/pair_rules.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd {
namespace {

GeometryDescription toGeometry(const WorldShape& made, const ResourceLoader& loader,
                               std::vector<std::string>& warnings) {
  GeometryDescription geometry;
  geometry.X_BG = made.X_BG;
  if (const Primitive* primitive = std::get_if<Primitive>(&made.shape)) {
    geometry.shape = *primitive;
    geometry.source = std::array<const char*, 4>{"sphere", "box", "cylinder", "plane"}[primitive->index()];
    return geometry;
  }
  if (const auto* mesh = std::get_if<std::shared_ptr<const TriangleMesh>>(&made.shape)) {
    geometry.shape = *mesh;
    geometry.source = "mesh";
    return geometry;
  }
  const auto* map = std::get_if<OctomapObject>(&made.shape);
  geometry.source = map ? map->uri : std::get<MeshObject>(made.shape).uri;
  const Resource file = loader(geometry.source);
  if (!file.warning.empty()) warnings.push_back(file.warning);
  if (map) {
    double resolution = 0.0;
    geometry.shape = std::make_shared<const TriangleMesh>(parseOctomapSurface(file.bytes, file.name, resolution));
    geometry.watertight_voxels = true;
    // The field's error, √3/2 of a cell, is then less than the depth at the centre of a single voxel: no voxel is
    // lost.
    geometry.cell_size = map->cell_size > 0.0 ? map->cell_size : 0.5 * resolution;
  } else {
    const Vector3d& scale = std::get<MeshObject>(made.shape).scale;
    geometry.shape = std::make_shared<const TriangleMesh>(scaled(parseMesh(file.bytes, file.name), scale));
  }
  return geometry;
}

}  // namespace

BodyDescription emptyWorldBody(const std::string& name, const std::string& frame, const Isometry3d& X_frame_B) {
  BodyDescription body;
  body.name = name;
  body.frame = frame;
  body.X_frame_B = X_frame_B;
  body.is_world = true;
  return body;
}

std::string whyNoName(const std::string& name) {
  if (!isSavedName(name))
    return "object '" + name + "': a name must not be empty, begin or end with a blank, or contain control characters";
  if (isPattern(name)) return "object " + name + ": a name must not contain * or ?, which are wildcards in patterns";
  return {};
}

BodyDescription toBody(const WorldObject& object, const std::string& frame, const ResourceLoader& loader,
                       std::vector<std::string>& warnings) {
  BodyDescription body = emptyWorldBody(object.name, frame, object.X_frame_B);
  try {
    for (const WorldShape& shape : object.shapes) {
      body.geometry.push_back(toGeometry(shape, loader, warnings));
      if (body.geometry.back().watertight_voxels && object.shapes.size() > 1)
        throw std::invalid_argument("an OctoMap cannot have other shapes beside it");
    }
  } catch (const std::exception& error) {
    body.geometry.clear();
    body.failure = "object " + object.name + ": " + error.what();
  }
  return body;
}

}  // namespace sdf_ccd
