#include "ros/world/message_object.h"

#include <algorithm>
#include <stdexcept>

#include "common/number_text.h"
#include "common/shown_text.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

Primitive toPrimitive(const shape_msgs::SolidPrimitive& message, const std::string& name) {
  using shape_msgs::SolidPrimitive;
  const std::vector<double>& size = message.dimensions;
  const std::size_t wanted = message.type == SolidPrimitive::BOX ? 3 : message.type == SolidPrimitive::SPHERE ? 1 : 2;
  if (message.type != SolidPrimitive::BOX && message.type != SolidPrimitive::SPHERE &&
      message.type != SolidPrimitive::CYLINDER)
    refuse(name + ": only BOX, SPHERE and CYLINDER are known, not type " + std::to_string(message.type));
  if (size.size() != wanted)
    refuse(name + ": " + std::to_string(size.size()) + " dimensions, not " + std::to_string(wanted));
  Primitive primitive = Sphere{size[0]};
  if (message.type == SolidPrimitive::BOX) primitive = Box{0.5 * Vector3d(size[0], size[1], size[2])};
  if (message.type == SolidPrimitive::CYLINDER)
    primitive = Cylinder{size[SolidPrimitive::CYLINDER_RADIUS], 0.5 * size[SolidPrimitive::CYLINDER_HEIGHT]};
  for (const double length : size)
    if (!(length > 0.0) || !(length <= kFarthestPose)) refuse(name + ": a dimension of " + numberText(length) + " m");
  return primitive;
}

std::shared_ptr<const TriangleMesh> toMesh(const shape_msgs::Mesh& message, const std::string& name,
                                           std::size_t& triangles) {
  if (message.triangles.empty()) refuse(name + ": no triangles");
  if (message.triangles.size() > triangles || message.vertices.size() > 3 * triangles)
    refuse(name + ": more triangles than one call may hold");
  triangles -= message.triangles.size();
  auto mesh = std::make_shared<TriangleMesh>();
  for (const geometry_msgs::Point& vertex : message.vertices) {
    mesh->vertices.push_back(toEigen(vertex));
    const Vector3d& p = mesh->vertices.back();
    if (!isNearOrigin(p)) refuse(name + ": a vertex that is not finite, or too far away");
  }
  for (const shape_msgs::MeshTriangle& triangle : message.triangles) {
    Vector3i corners;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle.vertex_indices[static_cast<std::size_t>(k)];
      if (vertex >= message.vertices.size())
        refuse(name + ": a triangle has vertex " + std::to_string(vertex) + ", of " +
               std::to_string(message.vertices.size()));
      corners[k] = static_cast<int>(vertex);
    }
    mesh->triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace

std::optional<Isometry3d> poseIn(const geometry_msgs::Pose& pose) {
  const Vector3d p = toEigen(pose.position);
  const Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  if (p.isZero(0.0) && q.coeffs().isZero(0.0)) return std::nullopt;
  if (!isNearOrigin(p)) refuse("a position that is not finite, or too far away");
  const auto known = poseOf(p, q);
  if (!known) refuse("an orientation that is no unit quaternion");
  return known;
}

void requireName(const std::string& name, const std::string& what, const RequestLimits& limits) {
  if (name.empty()) refuse(what + " is missing");
  if (name.size() > limits.name) refuse(what + " has more than " + std::to_string(limits.name) + " characters");
  if (name != shownText(name)) refuse(what + " " + shownText(name) + " holds control characters");
}

std::vector<WorldShape> shapesIn(const SceneChange& message, const RequestLimits& limits, std::size_t triangles) {
  std::vector<WorldShape> shapes;
  const std::size_t count = message.primitives.size() + message.planes.size() + message.meshes.size() +
                            message.mesh_resources.size();
  if (count > limits.shapes)
    refuse(std::to_string(count) + " shapes, at most " + std::to_string(limits.shapes) + " are taken");
  const auto add = [&](const auto& of_a_kind, const std::vector<geometry_msgs::Pose>& poses, const std::string& kind,
                       const auto& shapeOf) {
    if (!poses.empty() && poses.size() != of_a_kind.size())
      refuse(std::to_string(poses.size()) + " poses of " + std::to_string(of_a_kind.size()) + " " + kind);
    for (std::size_t i = 0; i < of_a_kind.size(); ++i) {
      const std::string name = kind + "[" + std::to_string(i) + "]";
      WorldShape& shape = shapes.emplace_back();
      shape.shape = shapeOf(of_a_kind[i], name, i);
      if (!poses.empty()) shape.X_BG = poseIn(poses[i]).value_or(Isometry3d::Identity());
    }
  };
  using Shape = decltype(WorldShape::shape);
  add(message.primitives, message.primitive_poses, "primitives",
      [](const auto& primitive, const std::string& name, std::size_t) { return Shape(toPrimitive(primitive, name)); });
  add(message.planes, message.plane_poses, "planes",
      [](const shape_msgs::Plane& plane, const std::string& name, std::size_t) {
        const auto& c = plane.coef;
        const bool finite = std::all_of(c.begin(), c.end(), [](double x) { return std::abs(x) <= kFarthestPose; });
        const auto solid = finite ? solidBelow({c[0], c[1], c[2]}, c[3]) : std::nullopt;
        if (!solid) refuse(name + ": no plane");
        return Shape(*solid);
      });
  add(message.meshes, message.mesh_poses, "meshes",
      [&](const auto& mesh, const std::string& name, std::size_t) { return Shape(toMesh(mesh, name, triangles)); });
  if (!message.mesh_resource_scales.empty() && message.mesh_resource_scales.size() != message.mesh_resources.size())
    refuse("as many mesh_resource_scales as mesh_resources are wanted, or none");
  add(message.mesh_resources, message.mesh_resource_poses, "mesh_resources",
      [&](const std::string& uri, const std::string& name, std::size_t i) {
        Vector3d scale = Vector3d::Ones();
        if (!message.mesh_resource_scales.empty()) {
          const geometry_msgs::Vector3& given = message.mesh_resource_scales[i];
          scale = {given.x, given.y, given.z};
          if (scale.isZero(0.0)) scale = Vector3d::Ones();
        }
        const bool is_scale = (scale.array().abs() > 0.0).all() && isNearOrigin(scale);
        if (!is_scale) refuse(name + ": a scale that is 0 or not finite");
        return Shape(MeshObject{uri, scale});
      });
  return shapes;
}

}  // namespace sdf_ccd
