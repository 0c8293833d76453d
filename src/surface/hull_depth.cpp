#include "hull_depth.h"

#include <algorithm>
#include <variant>

#include "mesh/triangle.h"

namespace sdf_ccd {
namespace {

constexpr double kNear = 2.5;  // radius of the triangles considered around a hull, relative to the hull's size
constexpr double kParallel = 1.0 - 1e-9;

class HullSearch {
 public:
  HullSearch(const SolidPart& part, const Hull& hull, double sufficient_bound)
      : part_(part), center_(part.X_GB * hull.center), size_(hull.size), sufficient_bound_(sufficient_bound) {
    for (int k = 0; k < 6; ++k) corners_[k] = part.X_GB * hull.corners[k];
  }

  HullDepth run() {
    const PartDepth depth = depthIn(part_, center_);
    found_.bound = depth.depth + size_;
    found_.at_corners.fill(found_.bound);
    if (!part_.solid && depth.out.isZero()) return found_;
    takeSide(depth, center_);
    if (part_.solid && !isDone()) {
      const Vector3d normal = normalOf(depth.triangle);
      takePlane(normal);
      if (!(normal.dot(depth.out) > kParallel)) takePlane(depth.out);
    }
    if (isDone()) return found_;
    // Where that bound is highest, another triangle may be nearer and give a tighter bound.
    const HullValues& best = sides_[best_];
    const Vector3d point = corners_[std::max_element(best.begin(), best.end()) - best.begin()];
    if (part_.solid) {
      PartDepth side;
      side.triangle = part_.solid->tree().closestPointNear(point, depth.triangle).triangle;
      if (side.triangle != depth.triangle) {
        takeSide(side, point);
        takePlane(normalOf(side.triangle));
      }
    } else if (const PartDepth side = depthIn(part_, point); !side.out.isZero()) {
      takeSide(side, point);
    }
    if (!part_.solid) takeRound(*part_.field->primitive());
    takeMeans();
    return found_;
  }

 private:
  bool isDone() const { return found_.bound <= sufficient_bound_; }

  Vector3d normalOf(int triangle) const {
    return areaNormal(part_.solid->tree().triangle(triangle).corners()).normalized();
  }

  void take(const HullValues& bounds) {
    const double largest = *std::max_element(bounds.begin(), bounds.end());
    found_.bound = std::min(found_.bound, largest);
    for (int k = 0; k < 6; ++k) found_.at_corners[k] = std::min(found_.at_corners[k], bounds[k]);
    if (largest < smallest_) best_ = count_;
    smallest_ = std::min(smallest_, largest);
    sides_[count_++] = bounds;
  }

  /// By the triangle nearest to a point, or by the plane in front of it.
  void takeSide(const PartDepth& side, const Vector3d& point) {
    HullValues bounds;
    for (int k = 0; k < 6; ++k) {
      bounds[k] = part_.solid ? part_.solid->tree().distanceTo(side.triangle, corners_[k])
                              : side.depth - side.out.dot(corners_[k] - point);
    }
    take(bounds);
  }

  /// By the plane that touches a round side where the hull comes nearest to its axis, or center. For a small hull the
  /// plane at its center is as good.
  void takeRound(const Primitive& primitive) {
    constexpr double kSmall = 0.6;
    const auto* ball = std::get_if<Sphere>(&primitive);
    const auto* cylinder = std::get_if<Cylinder>(&primitive);
    if (!ball && !cylinder) return;
    const Vector3d across(1.0, 1.0, cylinder ? 0.0 : 1.0);
    if (size_ < kSmall * center_.cwiseProduct(across).norm()) return;
    const Vector3d nearest = nearestToOrigin(across);
    const double distance = nearest.norm();
    if (!(distance > 0.0)) return;
    HullValues bounds;
    for (int k = 0; k < 6; ++k)
      bounds[k] = (ball ? ball->radius : cylinder->radius) - nearest.dot(corners_[k]) / distance;
    take(bounds);
  }

  /// The point of the hull, with coordinates scaled by `across`, that is nearest to the origin, or one that is not much
  /// farther: by Gilbert's algorithm, from the nearest point of an edge.
  Vector3d nearestToOrigin(const Vector3d& across) const {
    constexpr int kSteps = 4;
    std::array<Vector3d, 6> points;
    for (int k = 0; k < 6; ++k) points[k] = corners_[k].cwiseProduct(across);
    Vector3d nearest = points[0];
    const auto offer = [&](const Vector3d& from, const Vector3d& to) {
      const Vector3d point = closestOnSegment(from, to, Vector3d::Zero());
      if (point.squaredNorm() < nearest.squaredNorm()) nearest = point;
    };
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < i; ++j) offer(points[i], points[j]);
    for (int step = 0; step < kSteps; ++step) {
      const auto along = [&](const Vector3d& a, const Vector3d& b) { return nearest.dot(a) < nearest.dot(b); };
      offer(nearest, *std::min_element(points.begin(), points.end(), along));
    }
    return nearest;
  }

  /// By a plane with normal n that has all of the nearby solid behind it, if it is one.
  ///
  /// Within a ball about the center c no triangle extends farther along n than h: the part of the ball beyond h is
  /// entirely inside or entirely outside the solid, which one query decides. If it is outside, the ray along n from a
  /// point x of the hull that is inside leaves the solid at the plane or earlier, within h − n·x, as long as that is
  /// still in the ball. Points beyond the plane are bounded by their distance from the solid, or from points outside
  /// the ball.
  void takePlane(const Vector3d& n) {
    if (n.isZero()) return;
    const double radius = kNear * size_;
    HullValues along;
    for (int k = 0; k < 6; ++k) along[k] = n.dot(corners_[k] - center_);
    const auto [least, most] = std::minmax_element(along.begin(), along.end());
    // A plane farther out bounds no better, or the ray from a corner may leave the ball before it.
    const double farthest = std::min(found_.bound + *most, radius - size_ + *least);
    const double h = part_.solid->tree().farthestAlong(n, center_, radius, farthest);
    if (h > farthest || !(h < radius)) return;
    HullValues behind;
    for (int k = 0; k < 6; ++k) behind[k] = std::max(h - along[k], size_ - radius);
    if (!isInside(part_, center_ + radius * n)) take(behind);
  }

  void takeMeans() {
    for (std::size_t i = 0; i < count_; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (const double weight : {0.25, 0.5, 0.75}) {
          double largest = -kInfinity;
          for (int k = 0; k < 6; ++k)
            largest = std::max(largest, (1.0 - weight) * sides_[i][k] + weight * sides_[j][k]);
          found_.bound = std::min(found_.bound, largest);
        }
      }
    }
  }

  const SolidPart& part_;
  const Vector3d center_;
  std::array<Vector3d, 6> corners_;
  const double size_, sufficient_bound_;

  HullDepth found_;
  std::array<HullValues, 5> sides_;  // per bound: its values at the corners, between which it is convex
  std::size_t count_ = 0, best_ = 0;
  double smallest_ = kInfinity;
};

}  // namespace

HullDepth hullDepth(const SolidPart& part, const Hull& hull, double sufficient_bound) {
  return HullSearch(part, hull, sufficient_bound).run();
}

}  // namespace sdf_ccd
