#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry/generated_mesh.h"
#include "ros/tf/unit_rotation.h"
#include "sdf_ccd/geometry/primitive.h"
#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/motion/cycle_motion.h"

namespace sdf_ccd {

struct MeshObject {
  std::string uri;
  Vector3d scale = Vector3d::Ones();
};

struct WorldShape {
  std::variant<Primitive, MeshObject, std::shared_ptr<const TriangleMesh>> shape;
  Isometry3d X_BG = Isometry3d::Identity();  ///< in the object's frame B
};

/// Whether the point can be part of a pose; false for NaN, which lpNorm() may ignore.
inline bool isNearOrigin(const Vector3d& p) {
  return (p.array().abs() <= kFarthestPose).all();
}

/// The pose; none if q is not a unit quaternion.
inline std::optional<Isometry3d> poseOf(const Vector3d& p, const Quaterniond& q) {
  const std::optional<Quaterniond> rotation = unitRotation(q);
  if (!rotation) return std::nullopt;
  return Isometry3d(Eigen::Translation3d(p) * *rotation);
}

/// A cone, as messages define it: with its tip along z.
inline std::shared_ptr<const TriangleMesh> coneShape(double radius, double height) {
  return std::make_shared<const TriangleMesh>(coneMesh(radius, height));
}

/// The half-space n·x + d ≤ 0, as messages define planes; none if the normal is 0.
inline std::optional<Primitive> solidBelow(const Vector3d& n, double d) {
  if (!(n.norm() > 0.0)) return std::nullopt;
  return HalfSpace{n.normalized(), -d / n.norm()};
}

/// A static object of the world.
struct WorldObject {
  std::string name;
  std::string frame;  ///< empty: the fixed frame
  Isometry3d X_frame_B = Isometry3d::Identity();
  std::vector<WorldShape> shapes;  ///< one or more
};

}  // namespace sdf_ccd
