#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/ray_directions.h"
#include "mesh/triangle_tree.h"

namespace sdf_ccd {
namespace {

/// Where along the ray it comes within `slack` of the box, or infinity if it does not before `last`.
double entry(const AlignedBox3d& box, const Vector3d& p, const Vector3d& inverse, double slack, double last) {
  double enter = 0.0, exit = last;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.min()[k] - slack - p[k]) * inverse[k], b = (box.max()[k] + slack - p[k]) * inverse[k];
    // If the ray lies in the plane of a side, one of these is NaN, and the box may count as missed: see firstHit().
    const double low = a < b ? a : b, high = a < b ? b : a;
    if (low > enter) enter = low;
    if (high < exit) exit = high;
  }
  return enter <= exit * (1.0 + 1e-12) ? enter : kInfinity;
}

/// Distance along the ray to the triangle, infinity if it is missed (Möller & Trumbore 1997) by more than `slack`
/// beyond a side's line.
double hit(const MeasuredTriangle& t, const Vector3d& p, const Vector3d& direction, double slack) {
  const auto& [a, b, c] = t.corners();
  const Vector3d ab = b - a, ac = c - a, across = direction.cross(ac);
  const double determinant = ab.dot(across);
  if (determinant == 0.0) return kInfinity;
  const Vector3d from = p - a, along = from.cross(ab);
  const double u = from.dot(across) / determinant, v = direction.dot(along) / determinant;
  constexpr double kMin = -1e-12;
  double least_u = kMin, least_v = kMin, least_w = kMin;
  if (slack > 0.0) {  // the change of the coordinates over that distance across the ray
    const double steep = slack / std::abs(determinant);
    least_u -= steep * across.norm();
    least_v -= steep * direction.cross(ab).norm();
    least_w -= steep * direction.cross(ac - ab).norm();
  }
  const bool meets = u >= least_u && v >= least_v && 1.0 - u - v >= least_w;
  return meets ? ac.dot(along) / determinant : kInfinity;
}

}  // namespace

int TriangleTree::firstHit(const Vector3d& p, const Vector3d& direction, double min_distance) const {
  return firstHit(p, direction, min_distance, 0.0);
}

bool TriangleTree::seesOutside(const Vector3d& p) const {
  const double slack = kRayCracks * nodes_[0].box.sizes().maxCoeff();
  for (int i = 0; i < kRayDirections; ++i)
    if (firstHit(p, rayDirection(i), 0.0, slack) < 0) return true;
  return false;
}

int TriangleTree::firstHit(const Vector3d& p, const Vector3d& direction, double min_distance, double slack) const {
  struct Pending {
    double enter;
    std::int32_t node;
  };
  const Vector3d inverse = direction.cwiseInverse();
  double best = kInfinity;
  int found = -1;
  std::array<Pending, 128> stack;  // the builder keeps the depth below 96
  int size = 0;
  stack[size++] = {entry(nodes_[0].box, p, inverse, slack, best), 0};
  while (size > 0) {
    const Pending pending = stack[--size];
    if (!(pending.enter < best)) continue;
    const Node& node = nodes_[pending.node];
    if (node.count == 0) {
      Pending near = {entry(nodes_[node.first].box, p, inverse, slack, best), node.first};
      Pending far = {entry(nodes_[node.first + 1].box, p, inverse, slack, best), node.first + 1};
      if (far.enter < near.enter) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const double distance = hit(triangles_[i], p, direction, slack);
      if (distance > min_distance && distance < best) {
        best = distance;
        found = ids_[i];
      }
    }
  }
  return found;
}

}  // namespace sdf_ccd
