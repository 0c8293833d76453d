#include "object_body.h"

#include <array>
#include <stdexcept>

#include "sdf_ccd/import/mesh_file.h"

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
  const MeshObject& mesh = std::get<MeshObject>(made.shape);
  const Resource resource = loader(mesh.uri);
  if (!resource.warning.empty()) warnings.push_back(resource.warning);
  geometry.shape = std::make_shared<const TriangleMesh>(scaled(parseMesh(resource.bytes, resource.name), mesh.scale));
  geometry.source = mesh.uri;
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

BodyDescription toBody(const WorldObject& object, const std::string& frame, const ResourceLoader& loader,
                       std::vector<std::string>& warnings) {
  BodyDescription body = emptyWorldBody(object.name, frame, object.X_frame_B);
  try {
    for (const WorldShape& shape : object.shapes) body.geometry.push_back(toGeometry(shape, loader, warnings));
  } catch (const std::exception& error) {
    body.geometry.clear();
    body.failure = "object " + object.name + ": " + error.what();
  }
  return body;
}

}  // namespace sdf_ccd
