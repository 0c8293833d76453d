#include "hull_direction.h"

#include <algorithm>
#include <cmath>

#include "common/infinity.h"
#include "mesh/triangle.h"

namespace sdf_ccd {
namespace {

/// A point of the tree's surface that is farthest along a direction, up to rounding in single precision.
Vector3d supportPoint(const BoxTree& tree, const Vector3d& n) {
  constexpr int kMaxBoxes = 256;
  const std::array<float, 3> direction{float(n.x()), float(n.y()), float(n.z())};
  const double rounding = kBoxRounding * tree.ball().radius;
  std::array<std::int32_t, kMaxBoxes> pending;
  int size = 0;
  double best = -kInfinity;
  Vector3d point = tree.origin();
  pending[size++] = 0;
  while (size > 0) {
    const BoxTree::Node& node = tree.node(pending[--size]);
    BoxTree::Node::Lane supports;
    boxSupports(node, direction, {}, supports);
    for (int i = 0; i < node.count; ++i) {
      if (!(supports[i] > best + rounding)) continue;
      if (!BoxTree::isTriangle(node.below[i])) {
        if (size < kMaxBoxes) pending[size++] = node.below[i];
        continue;
      }
      const RoundedTriangle& t = tree.triangle(BoxTree::triangleOf(node.below[i]));
      for (const Vector3d& p : t.corners) {
        const double reach = n.dot(p - tree.origin()) + t.radius;
        if (!(reach > best)) continue;
        best = reach;
        point = p + t.radius * n;
      }
    }
  }
  return point;
}

/// How far the tree's triangles extend along a direction, from its origin.
double extentOf(const BoxTree& tree, const Vector3d& n) {
  double extent = -kInfinity;
  for (int i = 0; i < static_cast<int>(tree.size()); ++i) {
    const RoundedTriangle& t = tree.triangle(i);
    for (const Vector3d& p : t.corners) extent = std::max(extent, n.dot(p - tree.origin()) + t.radius);
  }
  return extent;
}

/// The points of B at both poses minus those of A, from A's origin: only its extreme points are ever found.
class Difference {
 public:
  Difference(const BoxTree& a, const BoxTree& b, const EndPoses& poses) : a_(a), b_(b), poses_(poses) {}

  Vector3d endA(const Vector3d& n) const { return supportPoint(a_, n) - a_.origin(); }

  Vector3d beginB(const Vector3d& n) const {
    const auto at = [&](const Isometry3d& X) {
      return Vector3d(X * supportPoint(b_, -(X.linear().transpose() * n)) - a_.origin());
    };
    const Vector3d start = at(poses_.X_AB_start), end = at(poses_.X_AB_end);
    return n.dot(start) < n.dot(end) ? start : end;
  }

  /// The point least far along n.
  Vector3d least(const Vector3d& n) const { return beginB(n) - endA(n); }

  Vector3d middle() const {
    return 0.5 * (poses_.X_AB_start * b_.origin() + poses_.X_AB_end * b_.origin()) - a_.origin();
  }

 private:
  const BoxTree &a_, &b_;
  const EndPoses& poses_;
};

/// Up to four points, and the point of their hull that is nearest to the origin.
class Simplex {
 public:
  const Vector3d& nearest() const { return nearest_; }

  /// Adds a point; of four, those of the face nearest to the origin are kept. @return whether the hull may still be
  /// apart from the origin.
  bool add(const Vector3d& point) {
    points_[size_++] = point;
    if (size_ < 4) {
      nearest_ = nearestOf(0, std::min(1, size_ - 1), size_ - 1);
      return true;
    }
    double least = kInfinity;
    int left_out = -1;
    for (int k = 0; k < 3; ++k) {  // faces with the new point
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const Vector3d normal = (points_[i] - points_[3]).cross(points_[j] - points_[3]);
      const double inside = normal.dot(points_[k] - points_[3]), origin = -normal.dot(points_[3]);
      if (inside * origin > 0.0) continue;  // the origin is on the side of the fourth point
      const Vector3d p = nearestOf(i, j, 3);
      if (p.squaredNorm() >= least) continue;
      least = p.squaredNorm();
      nearest_ = p;
      left_out = k;
    }
    if (left_out < 0) return false;
    points_[left_out] = points_[3];
    size_ = 3;
    return true;
  }

 private:
  Vector3d nearestOf(int i, int j, int k) const {
    return closestOnTriangle({points_[i], points_[j], points_[k]}, Vector3d::Zero());
  }

  std::array<Vector3d, 4> points_;
  int size_ = 0;
  Vector3d nearest_ = Vector3d::Zero();
};

}  // namespace

ExtentsAlong extentsAlong(const BoxTree& a, const BoxTree& b, const EndPoses& poses, const Vector3d& n_A) {
  const Difference difference(a, b, poses);
  return {n_A.dot(difference.endA(n_A)), n_A.dot(difference.beginB(n_A))};
}

double gapAlong(const BoxTree& a, const BoxTree& b, const EndPoses& poses, const Vector3d& n_A) {
  double begin_b = kInfinity;
  for (const Isometry3d& X : {poses.X_AB_start, poses.X_AB_end}) {
    const Vector3d n_B = X.linear().transpose() * n_A;
    begin_b = std::min(begin_b, n_A.dot(X * b.origin() - a.origin()) - extentOf(b, -n_B));
  }
  return begin_b - extentOf(a, n_A);
}

std::optional<Vector3d> hullDirection(const BoxTree& a, const BoxTree& b, const EndPoses& poses) {
  constexpr int kMaxSteps = 24;
  constexpr double kEnough = 0.8;  // of the distance of the hulls
  const Difference difference(a, b, poses);
  Simplex simplex;
  Vector3d v = difference.middle();
  std::optional<Vector3d> best;
  double best_gap = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double length = v.norm();
    if (!(length > 0.0)) break;
    const Vector3d n = v / length, w = difference.least(n);
    const double gap = n.dot(w);
    if (gap > best_gap) {
      best_gap = gap;
      best = n;
    }
    if (step > 0 && gap > kEnough * length) break;
    if (!simplex.add(w)) return std::nullopt;
    if (step > 0 && !(simplex.nearest().norm() < length)) break;  // as near as rounding allows
    v = simplex.nearest();
  }
  return best;
}

}  // namespace sdf_ccd
