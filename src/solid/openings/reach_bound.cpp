#include "reach_bound.h"

#include <algorithm>

#include "common/cancel_point.h"

namespace sdf_ccd {

double ReachBound::of(const Corners& t) {
  constexpr int kParts = 5;  // number of halvings
  return bound(t, kParts);
}

/// The distance from one triangle of the mesh is convex, so its largest value at the corners is a bound. For a sliver
/// that bridges a crack, several triangles are equally near to its middle, and one of them is near to all of it.
double ReachBound::boundByOne(const Corners& t) {
  checkCancelled();
  const Vector3d center = centroid(t);
  const TriangleTree::ClosestPoint nearest = tree_.closestPoint(center);
  least_ = nearest.distance;
  near_.assign(1, nearest.triangle);
  if (nearest.distance < crack_) tree_.trianglesWithin(center, crack_, near_);
  double best = nearest.distance + farthestDistance(t, center);
  for (const int triangle : near_) {
    double at_corners = 0.0;
    for (const Vector3d& p : t) at_corners = std::max(at_corners, tree_.distanceTo(triangle, p));
    best = std::min(best, at_corners);
  }
  return best;
}

double ReachBound::bound(const Corners& t, int depth) {
  const double whole = boundByOne(t);
  if (depth == 0 || whole <= 2.0 * least_) return whole;
  // The parts of a triangle may be near to other triangles of the mesh.
  int longest = 0;
  for (int k = 1; k < 3; ++k) {
    if ((t[(k + 1) % 3] - t[k]).squaredNorm() > (t[(longest + 1) % 3] - t[longest]).squaredNorm()) longest = k;
  }
  const Vector3d &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3], middle = 0.5 * (a + b);
  const double first = bound({a, middle, c}, depth - 1);
  return first >= whole ? whole : std::min(whole, std::max(first, bound({middle, b, c}, depth - 1)));
}

}  // namespace sdf_ccd
