#include "dynamics/collision_shape.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "scene/build_body.h"
#include "sdf_ccd/field.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

/// A ball about the body's origin, which is the centre of the balls of all poses.
BoundingBall ballAround(const CollisionShape& shape) {
  BoundingBall ball;
  const PointShell& shell = shape.shell;
  for (const Vector3d& p : shell.points()) ball.radius = std::max(ball.radius, p.norm());
  if (shape.field) {
    const AlignedBox3d& box = shape.field->surfaceBox();
    const Vector3d reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs());
    // A box's corners are outside a sphere's surface; the points, with the gap between them, are a closer bound.
    ball.radius = shell.size() > 0 ? ball.radius + shell.covering_radius : reach.norm();
  }
  return ball;
}

std::shared_ptr<const CollisionShape> shapeOf(GeometryDescription geometry, const BodyOptions& options) {
  BodyDescription description;
  description.geometry.push_back(std::move(geometry));
  BodyNeeds needs;
  needs.shell = whyNoShell(description).empty();
  MeshPool pool(options);
  Body body = buildBody(description, needs, options, pool, {}).body;
  if (!body.failure.empty()) throw std::invalid_argument(body.failure);
  CollisionShape shape{body.parts.front().field, *body.shell, *body.tree, {}};
  shape.ball = ballAround(shape);
  return std::make_shared<const CollisionShape>(std::move(shape));
}

}  // namespace

std::shared_ptr<const CollisionShape> makeShape(const TriangleMesh& mesh_B, FieldOptions field,
                                                const ShellOptions& shell) {
  // Inside, the surface is never farther than half the smallest side of its box.
  field.band = std::max(field.band, 0.5 * boundingBox(mesh_B).sizes().minCoeff());
  BodyOptions options;
  options.field = field;
  options.shell = shell;
  options.motion_margin = 0.0;
  return shapeOf({std::make_shared<const TriangleMesh>(mesh_B), Isometry3d::Identity(), "mesh"}, options);
}

std::shared_ptr<const CollisionShape> makeShape(const Primitive& primitive, const ShellOptions& shell) {
  BodyOptions options;
  options.shell = shell;
  return shapeOf({primitive, Isometry3d::Identity(), "primitive"}, options);
}

std::shared_ptr<const CollisionShape> makeShape(PointShell shell) {
  CollisionShape shape;
  shape.shell = std::move(shell);
  shape.tree = buildSphereTree(shape.shell);
  shape.ball = ballAround(shape);
  return std::make_shared<const CollisionShape>(std::move(shape));
}

}  // namespace sdf_ccd
