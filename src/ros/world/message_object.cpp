#include "ros/world/message_object.h"

#include <algorithm>
#include <stdexcept>

#include "common/number_text.h"
#include "common/refuse.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd {
namespace {

WorldShape::Shape toShape(const shape_msgs::SolidPrimitive& message, const std::string& name) {
  const std::vector<double>& size = message.dimensions;
  if (!isSolidType(message.type))
    refuse(name + ": type " + std::to_string(message.type) + " is not supported, only BOX, SPHERE, CYLINDER and CONE");
  const auto type = static_cast<SolidType>(message.type);
  if (size.size() != dimensionsOf(type))
    refuse(name + " has " + std::to_string(size.size()) + " dimensions instead of " +
           std::to_string(dimensionsOf(type)));
  for (const double length : size)
    if (!(length > 0.0) || !(length <= kFarthestPose))
      refuse(name + ": dimension " + numberText(length) + " m is not positive, or too large");
  return solidShape(type, size);
}

std::shared_ptr<const TriangleMesh> toMesh(const shape_msgs::Mesh& message, const std::string& name,
                                           std::size_t& triangles) {
  if (message.triangles.empty()) refuse(name + " has no triangles");
  if (message.triangles.size() > triangles || message.vertices.size() > 3 * triangles)
    refuse(name + " has too many triangles or vertices for one call");
  triangles -= message.triangles.size();
  auto mesh = std::make_shared<TriangleMesh>();
  for (const geometry_msgs::Point& vertex : message.vertices) {
    mesh->vertices.push_back(toEigen(vertex));
    const Vector3d& p = mesh->vertices.back();
    if (!isNearOrigin(p)) refuse(name + " has a vertex that is not finite, or too far from the origin");
  }
  for (const shape_msgs::MeshTriangle& triangle : message.triangles) {
    Vector3i corners;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t vertex = triangle.vertex_indices[static_cast<std::size_t>(k)];
      if (vertex >= message.vertices.size())
        refuse(name + " has a triangle with vertex index " + std::to_string(vertex) + ", but only " +
               std::to_string(message.vertices.size()) + " vertices");
      corners[k] = static_cast<int>(vertex);
    }
    mesh->triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace

bool hasPose(const SceneChange& message) {
  const geometry_msgs::Point& p = message.pose.position;
  const geometry_msgs::Quaternion& q = message.pose.orientation;
  const auto isZero = [](double number) { return number == 0.0; };
  const auto numbers = {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
  return !std::all_of(numbers.begin(), numbers.end(), isZero);
}

Isometry3d poseIn(const geometry_msgs::Pose& pose, const std::string& name) {
  try {
    return toIsometry(pose);
  } catch (const std::invalid_argument& problem) {
    refuse(name + ": " + problem.what());
  }
}

bool hasShapes(const SceneChange& message) {
  return !message.primitives.empty() || !message.planes.empty() || !message.meshes.empty() ||
         !message.mesh_resources.empty() || !message.octomap_file.empty();
}

std::vector<WorldShape> shapesIn(const SceneChange& message, const RequestLimits& limits, std::size_t triangles) {
  std::vector<WorldShape> shapes;
  const std::size_t count =
      message.primitives.size() + message.planes.size() + message.meshes.size() + message.mesh_resources.size();
  if (count > limits.shapes)
    refuse(std::to_string(count) + " shapes: at most " + std::to_string(limits.shapes) + " are allowed in one change");
  const auto add = [&](const auto& elements, const std::vector<geometry_msgs::Pose>& poses, const std::string& kind,
                       const auto& shapeOf) {
    if (!poses.empty() && poses.size() != elements.size())
      refuse(std::to_string(poses.size()) + " poses for " + std::to_string(elements.size()) + " " + kind);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const std::string name = kind + "[" + std::to_string(i) + "]";
      WorldShape& shape = shapes.emplace_back();
      shape.shape = shapeOf(elements[i], name, i);
      if (!poses.empty()) shape.X_BG = poseIn(poses[i], "the pose of " + name);
    }
  };
  using Shape = WorldShape::Shape;
  add(message.primitives, message.primitive_poses, "primitives",
      [](const auto& primitive, const std::string& name, std::size_t) { return toShape(primitive, name); });
  add(message.planes, message.plane_poses, "planes",
      [](const shape_msgs::Plane& plane, const std::string& name, std::size_t) {
        const auto& c = plane.coef;
        const bool finite = std::all_of(c.begin(), c.end(), [](double x) { return std::abs(x) <= kFarthestPose; });
        const auto solid = finite ? solidBelow({c[0], c[1], c[2]}, c[3]) : std::nullopt;
        if (!solid) refuse(name + ": the normal is zero, or a coefficient is not finite or too large");
        return Shape(*solid);
      });
  add(message.meshes, message.mesh_poses, "meshes",
      [&](const auto& mesh, const std::string& name, std::size_t) { return Shape(toMesh(mesh, name, triangles)); });
  if (!message.mesh_resource_scales.empty() && message.mesh_resource_scales.size() != message.mesh_resources.size())
    refuse("mesh_resource_scales must be empty, or have one scale per mesh_resource");
  add(message.mesh_resources, message.mesh_resource_poses, "mesh_resources",
      [&](const std::string& uri, const std::string& name, std::size_t i) {
        Vector3d scale = Vector3d::Ones();
        if (!message.mesh_resource_scales.empty()) {
          const geometry_msgs::Vector3& given = message.mesh_resource_scales[i];
          scale = {given.x, given.y, given.z};
        }
        const bool is_scale = (scale.array().abs() > 0.0).all() && isNearOrigin(scale);
        if (!is_scale) refuse(name + ": a component of the scale is zero, not finite or too large");
        return Shape(MeshObject{uri, scale});
      });
  return shapes;
}

}  // namespace sdf_ccd
