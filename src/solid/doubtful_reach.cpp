#include "doubtful_reach.h"

#include <algorithm>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

/// The largest distance of a point of triangles from others, by branch and bound. Distance from a single triangle is
/// convex: within another one it is largest at a corner.
class ReachSearch {
 public:
  ReachSearch(const TriangleTree& others, double tolerance) : others_(others), tolerance_(tolerance) {}

  /// Upper bound of the distance of any point, not above that of a single point by more than the tolerances.
  double reach() const { return reach_; }

  void add(const Corners& t) {
    if (--queries_left_ < 0) reach_ = kInfinity;
    if (reach_ == kInfinity) return;
    const TriangleTree::ClosestPoint nearest = others_.closestPoint((t[0] + t[1] + t[2]) / 3.0);
    double bound = 0.0;
    for (const Vector3d& corner : t) bound = std::max(bound, others_.distanceTo(nearest.triangle, corner));
    reach_ = std::max(reach_, std::min(bound, 1.1 * nearest.distance + tolerance_));
    if (bound <= reach_) return;
    int edge = 0;
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double length = (t[(k + 1) % 3] - t[k]).norm();
      if (length > longest) edge = k;
      longest = std::max(longest, length);
    }
    const int next = (edge + 1) % 3;
    Corners first = t, second = t;
    first[next] = second[edge] = 0.5 * (t[edge] + t[next]);
    add(first);
    add(second);
  }

 private:
  const TriangleTree& others_;
  const double tolerance_;
  double reach_ = 0.0;
  int queries_left_ = 100'000;
};

}  // namespace

double reachFrom(const TriangleTree& others, const std::vector<Corners>& triangles, double tolerance) {
  ReachSearch search(others, tolerance);
  for (const Corners& t : triangles) search.add(t);
  return search.reach();
}

}  // namespace sdf_ccd
