#include <limits>
#include <stdexcept>

#include "dynamics/rigid_body.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {
namespace {

/// About the body's origin, which the balls of all poses then share.
BoundingBall ballAround(const CollisionShape& shape) {
  BoundingBall ball;
  for (const Vector3d& p : shape.shell.points) ball.radius = std::max(ball.radius, p.norm());
  if (shape.field) {
    const AlignedBox3d& box = shape.field->surfaceBox();
    const Vector3d reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
    // A box's corners reach beyond a sphere's surface; the points, with the gap between them, are nearer to the truth.
    ball.radius = shape.shell.size() > 0 ? ball.radius + shape.shell.covering_radius : reach.norm();
  }
  return ball;
}

CollisionShape finished(CollisionShape shape) {
  shape.tree = buildSphereTree(shape.shell);
  shape.ball = ballAround(shape);
  return shape;
}

}  // namespace

CollisionShape makeShape(const TriangleMesh& mesh_B, FieldOptions field, const ShellOptions& shell) {
  // Nowhere inside is the surface farther than half the smallest side of its box.
  field.band = std::max(field.band, 0.5 * boundingBox(mesh_B).sizes().minCoeff());
  CollisionShape shape;
  shape.field = buildField(mesh_B, field);
  shape.shell = sampleSurface(mesh_B, shell);
  return finished(std::move(shape));
}

CollisionShape makeShape(const Primitive& primitive, const ShellOptions& shell) {
  CollisionShape shape;
  shape.field = DistanceField(primitive);
  if (!isHalfSpace(primitive)) shape.shell = sampleSurface(primitive, shell);
  return finished(std::move(shape));
}

CollisionShape makeShape(PointShell shell) {
  CollisionShape shape;
  shape.shell = std::move(shell);
  return finished(std::move(shape));
}

}  // namespace sdf_ccd
