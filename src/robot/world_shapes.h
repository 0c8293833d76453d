#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/generated_mesh.h"
#include "motion/valid_pose.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// A cone with its tip along z.
inline WorldShape::Shape coneShape(double radius, double height) {
  return std::make_shared<const TriangleMesh>(coneMesh(radius, height));
}

/// Boxes, spheres, cylinders and cones, as shape_msgs/SolidPrimitive numbers them and orders their dimensions.
enum class SolidType { kBox = 1, kSphere, kCylinder, kCone };

inline bool isSolidType(int type) {
  return type >= static_cast<int>(SolidType::kBox) && type <= static_cast<int>(SolidType::kCone);
}

inline std::size_t dimensionsOf(SolidType type) {
  return type == SolidType::kBox ? 3 : type == SolidType::kSphere ? 1 : 2;
}

/// @param size  dimensionsOf(type) positive lengths [m].
inline WorldShape::Shape solidShape(SolidType type, const std::vector<double>& size) {
  if (type == SolidType::kBox) return Primitive(Box::fromSize(Vector3d(size[0], size[1], size[2])));
  if (type == SolidType::kSphere) return Primitive(Sphere{size[0]});
  if (type == SolidType::kCylinder) return Primitive(Cylinder::fromRadiusAndLength(size[1], size[0]));
  return coneShape(size[1], size[0]);
}

/// The half-space n·x + d ≤ 0, as messages define planes; none if the normal is 0.
inline std::optional<Primitive> solidBelow(const Vector3d& n, double d) {
  if (!(n.norm() > 0.0)) return std::nullopt;
  return HalfSpace{n.normalized(), -d / n.norm()};
}

/// Most objects of a world; more are refused.
constexpr std::size_t kMaxObjects = 5000;

}  // namespace sdf_ccd
