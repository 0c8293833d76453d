#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sdf_ccd/contact/wrench.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/field/field_options.h"
#include "sdf_ccd/geometry/primitive.h"
#include "sdf_ccd/geometry/triangle_mesh.h"
#include "sdf_ccd/motion/screw_motion.h"
#include "sdf_ccd/shell/point_shell.h"
#include "sdf_ccd/shell/sample_surface.h"
#include "sdf_ccd/shell/sphere_tree.h"

namespace sdf_ccd {

/// What contact sees of a body, in the body's frame B, whose origin is its centre of mass. Bodies may share one.
struct CollisionShape {
  std::optional<DistanceField> field;  ///< none: the body is only ever a shell
  PointShell shell;                    ///< empty: the body is only ever a field
  SphereTree tree;
  BoundingBall ball;  ///< holds points and surface; infinite for a half-space
};

/// A shape's field and shell from a closed mesh. The field holds exact samples all through the solid, so that deep
/// overlaps have a depth.
/// @param mesh_B  about the centre of mass; its components are turned outward.
/// @throws std::invalid_argument if they cannot be made.
CollisionShape makeShape(const TriangleMesh& mesh_B, FieldOptions field, const ShellOptions& shell);

/// The same of a primitive: the field is exact. A half-space has no shell.
CollisionShape makeShape(const Primitive& primitive, const ShellOptions& shell);

/// A shape of points only.
CollisionShape makeShape(PointShell shell);

/// A rigid body.
struct RigidBody {
  std::string name;
  std::shared_ptr<const CollisionShape> shape;
  double mass = 0.0;                    ///< [kg]; not read if fixed
  Matrix3d inertia = Matrix3d::Zero();  ///< about B's origin, in B's axes [kg·m²]; not read if fixed
  bool fixed = false;                   ///< never moves
  Wrench applied;                       ///< user force, in the scene's axes, about B's origin [N, N·m]
};

/// Where a body is and how it moves, in the scene's frame O.
struct BodyState {
  Isometry3d X_OB = Isometry3d::Identity();
  Vector3d velocity = Vector3d::Zero();  ///< of B's origin [m/s], O's axes
  Vector3d spin_B = Vector3d::Zero();    ///< angular velocity [rad/s], B's axes
};

}  // namespace sdf_ccd
