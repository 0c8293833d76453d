#include "depth_solid.h"

#include <optional>

namespace sdf_ccd {
namespace {

/// Whether the point is inside, if the triangle nearest to it tells: it separates the outside from the inside, and the
/// point is before or behind its middle, so that nothing lies between. At an edge or a corner, other triangles as near
/// may be on the other side.
std::optional<bool> insideBy(const TriangleTree::ClosestPoint& nearest, const Solid& solid, const Vector3d& p) {
  constexpr double kFromSides = 1e-4;  // of the distance: far more than the nearest point's rounding
  const bool is_apart = nearest.distance > 1e-9 * (1.0 + p.norm());
  if (!is_apart || nearest.triangle < 0 || !solid.separates()[nearest.triangle]) return std::nullopt;
  const Corners& t = solid.tree().triangle(nearest.triangle).corners();
  const Vector3d normal = areaNormal(t);
  for (int k = 0; k < 3; ++k) {
    const Vector3d side = t[(k + 1) % 3] - t[k];
    const double from_side = normal.cross(side).dot(nearest.point - t[k]);  // times the lengths of both
    if (!(from_side > kFromSides * nearest.distance * normal.norm() * side.norm())) return std::nullopt;
  }
  return normal.dot(p - nearest.point) < 0.0;
}

PointDepth depthIn(const Solid& solid, const Vector3d& p, int likely) {
  const TriangleTree& tree = solid.tree();
  const TriangleTree::ClosestPoint nearest = likely < 0 ? tree.closestPoint(p) : tree.closestPointNear(p, likely);
  const std::optional<bool> is_behind = insideBy(nearest, solid, p);
  const bool inside = is_behind ? *is_behind : solid.inside(p);
  Vector3d out = (inside ? 1.0 : -1.0) * (nearest.point - p);
  // On the surface (up to rounding) the outward direction is the triangle's own normal.
  if (!(nearest.distance > 1e-9 * (1.0 + p.norm()))) out = areaNormal(tree.triangle(nearest.triangle).corners());
  return {inside ? nearest.distance : -nearest.distance, nearest.triangle, out.normalized()};
}

}  // namespace

DepthSolid::DepthSolid(std::shared_ptr<const Solid> solid, const Isometry3d& X_BG, double deviation,
                       std::shared_ptr<const Solid> inner)
    : X_BG_(X_BG), deviation_(deviation + solid->seam()), inner_(std::move(inner)) {
  Mesh mesh;
  mesh.solid = std::move(solid);
  mesh.box = boundingBox(mesh.solid->boundary());
  const TriangleMesh& boundary = mesh.solid->boundary();
  const double size = mesh.box.sizes().norm();
  for (std::size_t i = 0; i < boundary.triangles.size(); ++i) {
    const Corners corners = cornersOf(boundary, static_cast<int>(i));
    const Vector3d normal = areaNormal(corners).normalized();
    // A plane that cuts off more bounds nothing well.
    const double most = 1e-6 * size;
    const double beyond =
        normal.isZero() ? kInfinity : mesh.solid->tree().farthestAlong(normal, corners[0], kInfinity, most);
    mesh.protrusion.push_back(beyond <= most ? std::max(0.0, beyond) : kInfinity);
  }
  shape_ = std::move(mesh);
}

PointDepth DepthSolid::at(const Vector3d& p, int likely) const {
  if (const auto* ball = std::get_if<Sphere>(&shape_)) {
    const double distance = p.norm();
    return {ball->radius - distance, -1, distance > 0.0 ? Vector3d(p / distance) : Vector3d(Vector3d::UnitZ())};
  }
  if (const auto* plane = std::get_if<HalfSpace>(&shape_))
    return {plane->offset - plane->normal.dot(p), -1, plane->normal};
  return depthIn(*mesh().solid, p, likely);
}

double DepthSolid::leastDepth(const Vector3d& p, double depth) const {
  return inner_ ? std::min(depth, depthIn(*inner_, p, -1).depth) : depth;
}

double DepthSolid::greatestDepth() const {
  if (const auto* ball = std::get_if<Sphere>(&shape_)) return ball->radius;
  return std::holds_alternative<HalfSpace>(shape_) ? kInfinity : 0.5 * mesh().box.sizes().minCoeff();
}

double DepthSolid::radius() const {
  const auto* ball = std::get_if<Sphere>(&shape_);
  return ball ? ball->radius : 0.0;
}

double DepthSolid::distanceBound(const Vector3d& p) const {
  const auto* of_mesh = std::get_if<Mesh>(&shape_);
  if (!of_mesh) return -at(p).depth;
  return of_mesh->box.contains(p) ? -kInfinity : of_mesh->box.exteriorDistance(p);
}

Vector3d DepthSolid::normalOf(int triangle) const {
  return areaNormal(mesh().solid->tree().triangle(triangle).corners()).normalized();
}

/// Within a ball no triangle extends farther along the normal than the plane: the part of the ball beyond it is
/// entirely inside or entirely outside the solid, which one query decides. If it is outside, the ray along the normal
/// from a point inside the solid leaves that at the plane or earlier, as long as it is in the ball then.
DepthPlane DepthSolid::planeAlong(const Vector3d& normal, int triangle, const Vector3d& center, double size,
                                  const PointDepth& depth) const {
  constexpr double kNear = 2.5;
  DepthPlane plane;
  if (normal.isZero()) return plane;
  plane.normal = normal;
  if (const auto* ball = std::get_if<Sphere>(&shape_)) {
    plane.offset = ball->radius;
    plane.radius = kInfinity;
    return plane;
  }
  if (const auto* half_space = std::get_if<HalfSpace>(&shape_)) {
    plane.normal = half_space->normal;
    plane.offset = half_space->offset;
    plane.radius = kInfinity;
    return plane;
  }
  const TriangleTree& tree = mesh().solid->tree();
  if (triangle >= 0 && mesh().protrusion[triangle] < kInfinity) {
    plane.offset = normal.dot(tree.triangle(triangle).corners()[0]) + mesh().protrusion[triangle];
    plane.radius = kInfinity;
    return plane;
  }
  const double radius = std::max(0.0, depth.depth) + kNear * size;
  const double ahead = tree.farthestAlong(normal, center, radius, radius - size);
  if (!(ahead <= radius - size) || !(at(center + radius * normal, depth.triangle).depth < 0.0)) return plane;
  plane.offset = normal.dot(center) + ahead;
  plane.center = center;
  plane.radius = radius;
  return plane;
}

std::size_t DepthSolid::bytes() const {
  const auto* of_mesh = std::get_if<Mesh>(&shape_);
  const std::size_t of_inner = inner_ ? inner_->tree().bytes() : 0;
  return of_mesh ? of_mesh->solid->tree().bytes() + of_mesh->protrusion.size() * sizeof(double) + of_inner : 0;
}

}  // namespace sdf_ccd
