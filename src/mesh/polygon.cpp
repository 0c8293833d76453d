#include "polygon.h"

#include <numeric>

namespace sdf_ccd {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The polygon seen along its vector area, counter-clockwise.
std::vector<Vector2d> flattened(const std::vector<Vector3d>& corners) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += (corners[i] - corners[0]).cross(corners[(i + 1) % corners.size()] - corners[0]);
  }
  int axis;
  normal.cwiseAbs().maxCoeff(&axis);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double side = normal[axis] < 0 ? -1 : 1;
  std::vector<Vector2d> result;
  for (const Vector3d& corner : corners) result.emplace_back(corner[u], side * corner[v]);
  return result;
}

bool isEar(const std::vector<Vector2d>& points, const std::vector<int>& rest, std::size_t tip) {
  const std::size_t n = rest.size();
  const Vector2d &a = points[rest[(tip + n - 1) % n]], &b = points[rest[tip]], &c = points[rest[(tip + 1) % n]];
  if (!(cross(a, b, c) > 0)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d& p = points[rest[i]];
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<Vector3i> triangulatePolygon(const std::vector<Vector3d>& corners) {
  std::vector<Vector3i> triangles;
  if (corners.size() < 3) return triangles;
  std::vector<int> rest(corners.size());
  std::iota(rest.begin(), rest.end(), 0);
  const std::vector<Vector2d> points = corners.size() > 3 ? flattened(corners) : std::vector<Vector2d>();
  std::size_t tip = 0;
  while (rest.size() > 3) {
    const std::size_t n = rest.size();
    // If no corner is an ear (no area, or the polygon intersects itself), any corner is cut off.
    for (std::size_t tried = 0; tried < n && !isEar(points, rest, tip); ++tried) tip = (tip + 1) % n;
    triangles.emplace_back(rest[(tip + n - 1) % n], rest[tip], rest[(tip + 1) % n]);
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(tip));
    tip = (tip + 1) % (n - 1);  // the next ear elsewhere, or a convex polygon becomes a fan of slivers
  }
  triangles.emplace_back(rest[0], rest[1], rest[2]);
  return triangles;
}

}  // namespace sdf_ccd
