#include "geometry_extent.h"

#include <algorithm>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

using Mesh = std::shared_ptr<const TriangleMesh>;

AlignedBox3d boxOf(const GeometryDescription& element) {
  if (const Mesh* mesh = std::get_if<Mesh>(&element.shape)) return boundingBox(**mesh);
  return boundingBox(std::get<Primitive>(element.shape));
}

/// Points whose convex hull contains the element, in the body's frame: a mesh's vertices, else the corners of its box.
std::vector<Vector3d> hullPoints(const GeometryDescription& element) {
  std::vector<Vector3d> points;
  if (const Mesh* mesh = std::get_if<Mesh>(&element.shape)) {
    points = (*mesh)->vertices;
  } else {
    const AlignedBox3d box = boxOf(element);
    for (int i = 0; i < 8; ++i) points.push_back(box.corner(static_cast<AlignedBox3d::CornerType>(i)));
  }
  for (Vector3d& p : points) p = element.X_BG * p;
  return points;
}

}  // namespace

BoundingBall extentBall(const std::vector<GeometryDescription>& geometry) {
  AlignedBox3d box;
  std::vector<Vector3d> points;
  for (const GeometryDescription& element : geometry) {
    if (isHalfSpace(element)) return {Vector3d::Zero(), kInfinity};
    for (const Vector3d& p : hullPoints(element)) {
      box.extend(p);
      points.push_back(p);
    }
  }
  if (points.empty()) return {};
  BoundingBall ball{box.center(), 0.0};
  for (const Vector3d& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  return ball;
}

double distanceBelow(const std::vector<GeometryDescription>& geometry, const Vector3d& p) {
  double distance = kInfinity;
  for (const GeometryDescription& element : geometry) {
    const Vector3d p_G = element.X_BG.inverse() * p;
    const Primitive* primitive = std::get_if<Primitive>(&element.shape);
    distance = std::min(distance, primitive ? signedDistance(*primitive, p_G) : boxOf(element).exteriorDistance(p_G));
  }
  return distance;
}

std::vector<GeometryDescription> inBoxes(std::vector<GeometryDescription> geometry) {
  for (GeometryDescription& element : geometry) {
    if (!std::holds_alternative<Mesh>(element.shape)) continue;
    const AlignedBox3d box = boxOf(element);
    element.X_BG = element.X_BG * Eigen::Translation3d(box.center());
    element.shape = Primitive(Box{0.5 * box.sizes()});
  }
  return geometry;
}

}  // namespace sdf_ccd
