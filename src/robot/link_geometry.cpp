#include "link_geometry.h"

#include <stdexcept>

#include "common/shown_text.h"
#include "sdf_ccd/mesh.h"
#include "urdf_geometry.h"

namespace sdf_ccd {

std::vector<GeometryDescription> LinkGeometryLoader::load(const urdf::Link& link) {
  std::vector<GeometryDescription> geometry;
  for (const auto& collision : link.collision_array) {
    if (!collision || !collision->geometry) throw std::runtime_error("a collision element has no geometry");
    GeometryDescription element;
    element.X_BG = toEigen(collision->origin);
    switch (collision->geometry->type) {
      case urdf::Geometry::SPHERE: {
        const auto& sphere = static_cast<const urdf::Sphere&>(*collision->geometry);
        element.shape = Primitive(Sphere{sphere.radius});
        element.source = "sphere";
        break;
      }
      case urdf::Geometry::BOX: {
        const auto& box = static_cast<const urdf::Box&>(*collision->geometry);
        element.shape = Primitive(Box::fromSize(toEigen(box.dim)));
        element.source = "box";
        break;
      }
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision->geometry);
        element.shape = Primitive(Cylinder::fromRadiusAndLength(cylinder.radius, cylinder.length));
        element.source = "cylinder";
        break;
      }
      case urdf::Geometry::MESH: {
        const auto& file = static_cast<const urdf::Mesh&>(*collision->geometry);
        element.shape = mesh(file.filename, file.scale);
        element.source = file.filename;
        if (!renamed_.count(file.filename)) element.scale = toEigen(file.scale);
        break;
      }
      default:
        throw std::runtime_error("a collision element's geometry has an unknown type");
    }
    if (const Primitive* primitive = std::get_if<Primitive>(&element.shape)) validate(*primitive);
    geometry.push_back(std::move(element));
  }
  return geometry;
}

LinkGeometryLoader::Mesh LinkGeometryLoader::mesh(const std::string& uri, const urdf::Vector3& scale) {
  const Mesh original = unscaledMesh(uri);
  if (scale.x == 1.0 && scale.y == 1.0 && scale.z == 1.0) return original;
  Mesh& found = scaled_[{uri, {scale.x, scale.y, scale.z}}];
  try {
    if (!found) found = std::make_shared<TriangleMesh>(scaled(*original, toEigen(scale)));
  } catch (const std::exception& error) {
    throw std::runtime_error(shownText(uri) + ": " + error.what());
  }
  return found;
}

LinkGeometryLoader::Mesh LinkGeometryLoader::unscaledMesh(const std::string& uri) {
  const auto failure = failures_.find(uri);
  if (failure != failures_.end()) throw std::runtime_error(failure->second);
  Mesh& found = unscaled_[uri];
  if (found) return found;
  try {
    const Resource resource = loader_(uri);
    if (!resource.warning.empty()) {
      warnings_.push_back(resource.warning);
      renamed_.insert(uri);
    }
    found = std::make_shared<TriangleMesh>(parseMesh(resource.bytes, resource.name));
    validate(*found);
  } catch (const std::exception& error) {
    // Once for all links that use it; the URI is what the user can search for in the URDF.
    const std::string reason = error.what(), shown = shownText(uri);
    failures_[uri] = reason.find(shown) == std::string::npos ? shown + ": " + reason : reason;
    throw std::runtime_error(failures_[uri]);
  }
  return found;
}

}  // namespace sdf_ccd
