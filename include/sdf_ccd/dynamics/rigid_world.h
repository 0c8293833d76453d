#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sdf_ccd/contact/contact_model.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/mesh/primitive.h"
#include "sdf_ccd/mesh/triangle_mesh.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// Mass, centre of mass and inertia of a rigid body.
struct MassProperties {
  double mass = 0.0;                    ///< [kg]
  Vector3d center = Vector3d::Zero();   ///< centre of mass [m], in the geometry's frame
  Matrix3d inertia = Matrix3d::Zero();  ///< about the centre of mass, in the geometry's axes [kg·m²]
};

/// Mass properties of the solid inside a closed mesh, by the divergence theorem: the signed sum over the tetrahedra of
/// its triangles and the centre of its box (so that a mesh far from its frame's origin loses no digits).
///
/// @param density  [kg/m³], finite and positive.
/// @throws std::invalid_argument for a mesh that encloses no positive volume (open, flat, inside out), or a density
/// that is not valid. An open mesh that encloses volume is treated as if the tetrahedra closed it: check
/// MeshQuality::boundary_edges.
MassProperties massProperties(const TriangleMesh& mesh, double density);

/// Mass properties of a primitive, in closed form.
/// @throws std::invalid_argument for a half-space, whose mass is infinite.
MassProperties massProperties(const Primitive& primitive, double density);

/// Throws std::invalid_argument, with the value, unless a rigid body can have this mass and inertia: finite, positive,
/// symmetric, and principal moments of which none exceeds the sum of the others.
void validateInertia(double mass, const Matrix3d& inertia);

/// Collision geometry in the body's frame B, whose origin is the centre of mass. Several bodies may share it.
struct CollisionShape {
  std::optional<DistanceField> field;  ///< none: the body only has a shell
  PointShell shell;                    ///< empty: the body only has a field
  SphereTree tree;
  BoundingBall ball;  ///< contains points and surface; infinite for a half-space
};

/// Builds field and shell of a shape from a closed mesh. The field has exact samples in the whole solid, so that deep
/// overlaps have a depth.
/// @param mesh_B  about the centre of mass; its components are oriented outward.
/// @throws std::invalid_argument if field or shell cannot be built.
CollisionShape makeShape(const TriangleMesh& mesh_B, FieldOptions field, const ShellOptions& shell);

/// The same for a primitive: the field is exact. A half-space has no shell.
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

/// Pose and velocity of a body, in the scene's frame O.
struct BodyState {
  Isometry3d X_OB = Isometry3d::Identity();
  Vector3d velocity = Vector3d::Zero();  ///< of B's origin [m/s], O's axes
  Vector3d spin_B = Vector3d::Zero();    ///< angular velocity [rad/s], B's axes
};

/// Rigid bodies and the forces on them. The scene's frame O has the axes of the world and an origin near the bodies, so
/// that contact far from the world's origin is as accurate as near it.
struct RigidWorld {
  std::vector<RigidBody> bodies;
  Vector3d origin_W = Vector3d::Zero();          ///< of O [m]
  Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< [m/s²]
  ContactOptions contact;
  double chord_tolerance = 1e-3;  ///< deviation of a point's arc from its chords, as a share of its body's radius
};

/// A simulation cannot go on: which body, at which step, why.
class SimulationError : public std::runtime_error {
 public:
  /// Joins the three to one sentence.
  SimulationError(const std::string& body, long step, const std::string& reason)
      : std::runtime_error("body `" + body + "`, step " + std::to_string(step) + ": " + reason) {}
};

/// Throws SimulationError (step 0) that names the first body that cannot be simulated, or std::invalid_argument for
/// options that are not valid: a mass, inertia, force or state that is not finite or not positive, a body without field
/// and shell, a moving half-space.
void validate(const RigidWorld& world, const std::vector<BodyState>& states);

/// ½ m v² + ½ ω·Iω [J]; 0 for a fixed body.
double kineticEnergy(const RigidBody& body, const BodyState& state);

/// Momentum [N·s] and angular momentum about O's origin [N·m·s] of all bodies that move.
Wrench totalMomentum(const RigidWorld& world, const std::vector<BodyState>& states);

}  // namespace sdf_ccd
