#pragma once

#include "dynamics/collision_shape.h"
#include "oracle/shapes.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/simulation.h"
#include "shell/point_shell.h"

/// Rigid bodies for tests and studies.
namespace sdf_ccd::test {

/// A fixed body that fills the half-space below z = 0.
inline RigidBody groundBody() {
  RigidBody ground;
  ground.name = "ground";
  ground.fixed = true;
  ground.shape = makeShape(Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), ShellOptions{});
  return ground;
}

/// A point of unit area with mass; a contact at the point exerts no torque, so the inertia is arbitrary.
inline RigidBody pointBody(const std::string& name, double mass) {
  RigidBody body;
  body.name = name;
  body.mass = mass;
  body.inertia = mass * Matrix3d::Identity();
  PointShell point;
  point.add(Vector3d::Zero(), -Vector3d::UnitZ(), 1.0F);
  body.shape = makeShape(point);
  return body;
}

inline RigidBody primitiveBody(const std::string& name, const Primitive& primitive, double density, double spacing) {
  RigidBody body;
  body.name = name;
  const MassProperties mass = massProperties(primitive, density);
  body.mass = mass.mass;
  body.inertia = mass.inertia;
  ShellOptions shell;
  shell.spacing = spacing;
  body.shape = makeShape(primitive, shell);
  return body;
}

inline RigidBody meshBody(const std::string& name, const TriangleMesh& mesh, double density, int cells,
                          double spacing) {
  RigidBody body;
  body.name = name;
  const MassProperties mass = massProperties(mesh, density);
  body.mass = mass.mass;
  body.inertia = mass.inertia;
  FieldOptions field;
  field.cells = cells;
  ShellOptions shell;
  shell.spacing = spacing;
  body.shape = makeShape(translated(mesh, -mass.center), field, shell);
  return body;
}

inline BodyState at(const Vector3d& place, const Vector3d& velocity = Vector3d::Zero(),
                    const Vector3d& spin_B = Vector3d::Zero()) {
  BodyState state;
  state.X_OB.translation() = place;
  state.velocity = velocity;
  state.spin_B = spin_B;
  return state;
}

}  // namespace sdf_ccd::test
