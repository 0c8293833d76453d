#include "deepest_point.h"

#include <algorithm>
#include <cmath>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "hull_depth.h"

namespace sdf_ccd {

/// The search along one of the added motions.
class DeepestSearch::MotionSearch {
 public:
  MotionSearch(DeepestSearch& search, int index)
      : search_(search),
        index_(index),
        entry_(search.added_[index]),
        surface_(entry_.surface),
        solid_(entry_.solid),
        motion_(entry_.motion) {}

  void offerBoxes(int node_index) {
    const BoxTree& tree = *surface_.triangles;
    const BoxTree::Node& node = tree.node(node_index);
    for (int i = 0; i < node.count; ++i) {
      const Vector3d center = tree.origin() + Vector3d(node.center[0][i], node.center[1][i], node.center[2][i]);
      const double reach = node.reach[i];
      if (isHidden(center, reach)) continue;
      // All points stay within half of the travel of their positions halfway.
      const double bound = boundAround(entry_.X_FP[1] * center, reach + 0.5 * entry_.travel);
      if (BoxTree::isTriangle(node.below[i])) {
        const int index = BoxTree::triangleOf(node.below[i]);
        const RoundedTriangle& triangle = tree.triangle(index);
        const bool is_ball = triangle.radius > 0.0;
        add({bound, index_, -1, triangle.corners, triangle.radius, 0.0, 1.0, is_ball ? index : -1});
      } else {
        search_.push({bound, index_, node.below[i]});
      }
    }
  }

  /// Halves a piece in time or along its longest edge, whichever extends farther.
  void divide(const Piece& piece) {
    const Isometry3d X_start = entry_.poseAt(piece.start), X_end = entry_.poseAt(piece.end);
    const double length = piece.end - piece.start;
    double displacement = motion_.acceleration * length * length / 8.0, longest = -1.0;
    int edge = 0;
    for (int k = 0; k < 3; ++k) {
      displacement = std::max(displacement, (X_end * piece.corners[k] - X_start * piece.corners[k]).norm());
      const double side = (piece.corners[(k + 1) % 3] - piece.corners[k]).norm();
      if (side > longest) edge = k;
      longest = std::max(longest, side);
    }
    if (isWholeBall(piece) && displacement <= piece.radius) return divideBall(piece);
    // A resting point cannot be divided further.
    const bool is_short = length < 1e-9;
    if (longest == 0.0 && (displacement == 0.0 || is_short)) {
      search_.highest_left_ = std::max(search_.highest_left_, piece.bound);
      return;
    }
    Piece first = piece, second = piece;
    if (displacement > longest && !is_short) {
      first.end = second.start = 0.5 * (piece.start + piece.end);
    } else {
      if (isHidden(centroid(piece.corners), longest + piece.radius)) return;
      const int next = (edge + 1) % 3;
      first.corners[next] = second.corners[edge] = 0.5 * (piece.corners[edge] + piece.corners[next]);
      if (piece.ball >= 0) {
        const Vector3d onto = ontoBall(piece.ball, first.corners[next]);
        first.corners[next] = second.corners[edge] = onto;
        for (Piece* half : {&first, &second}) half->radius = capHeight(*half);
      }
    }
    add(first);
    add(second);
  }

 private:
  RoundedTriangle ballOf(int index) const { return surface_.triangles->triangle(index); }

  /// Not a part of its surface, whose corners lie on it.
  bool isWholeBall(const Piece& piece) const {
    return piece.ball >= 0 && piece.corners[0] == ballOf(piece.ball).corners[0];
  }

  /// The point of a ball's surface in the direction of a point.
  Vector3d ontoBall(int ball, const Vector3d& p) const {
    const RoundedTriangle of = ballOf(ball);
    return of.corners[0] + of.radius * (p - of.corners[0]).normalized();
  }

  /// Upper bound of the distance from a triangle with corners on a ball to the part of the surface over it.
  double capHeight(const Piece& piece) const {
    const RoundedTriangle& ball = ballOf(piece.ball);
    const Vector3d normal = areaNormal(piece.corners).normalized();
    const double to_plane = std::abs(normal.dot(piece.corners[0] - ball.corners[0]));
    return ball.radius - std::min(to_plane, ball.radius) + 1e-12 * ball.radius;
  }

  /// Into the faces of an octahedron.
  void divideBall(const Piece& piece) {
    const RoundedTriangle& ball = ballOf(piece.ball);
    for (int octant = 0; octant < 8; ++octant) {
      Piece part = piece;
      for (int axis = 0; axis < 3; ++axis) {
        part.corners[axis] = ball.corners[0];
        part.corners[axis][axis] += (octant >> axis & 1) ? ball.radius : -ball.radius;
      }
      part.radius = capHeight(part);
      add(part);
    }
  }

  /// Upper bound of the depth within `radius` of a point, from the fields' lower bounds alone.
  double boundAround(const Vector3d& p_F, double radius) const {
    double bound = -kInfinity;
    for (const SolidPart& part : solid_) bound = std::max(bound, radius - part.field->lowerBound(part.X_GB * p_F));
    return bound;
  }

  /// Whether the whole ball of `radius` around a point is surely inside the surface's own body.
  bool isHidden(const Vector3d& p_P, double radius) const {
    return std::any_of(surface_.parts.begin(), surface_.parts.end(), [&](const SolidPart& part) {
      return part.field->bounds(part.X_GB * p_P).high < -radius - search_.resolution_;
    });
  }

  /// Tightens a piece's bound and keeps the piece if it may contain a deeper point than the deepest known one.
  void add(Piece piece) {
    if (!search_.isDone(piece.bound)) measure(piece);
    search_.push(piece);
  }

  void measure(Piece& piece) {
    const Isometry3d X_start = entry_.poseAt(piece.start), X_end = entry_.poseAt(piece.end);
    Hull hull;
    for (int k = 0; k < 3; ++k) {
      hull.corners[k] = X_start * piece.corners[k];
      hull.corners[k + 3] = X_end * piece.corners[k];
      hull.center += (hull.corners[k] + hull.corners[k + 3]) / 6.0;
    }
    for (const Vector3d& corner : hull.corners) hull.size = std::max(hull.size, (corner - hull.center).norm());
    const double length = piece.end - piece.start;
    const double beyond = motion_.acceleration * length * length / 8.0 + piece.radius;
    HullDepth highest;
    highest.at_corners.fill(-kInfinity);
    for (const SolidPart& part : solid_) {
      HullDepth found;
      found.bound = hull.size - part.field->lowerBound(part.X_GB * hull.center);
      if (!search_.isDone(found.bound + beyond)) found = hullDepth(part, hull, search_.sufficientBound());
      for (int k = 0; k < 6; ++k) highest.at_corners[k] = std::max(highest.at_corners[k], found.at_corners[k]);
      highest.bound = std::max(highest.bound, found.bound);
    }
    piece.bound = std::min(piece.bound, highest.bound + beyond);
    if (search_.isDone(piece.bound)) return;
    if (isWholeBall(piece)) return offerRound(piece, X_start);
    const HullValues& deepest = highest.at_corners;
    const int best = static_cast<int>(std::max_element(deepest.begin(), deepest.end()) - deepest.begin());
    if (!search_.isDone(deepest[best]))
      offer(piece.corners[best % 3], hull.corners[best], best < 3 ? piece.start : piece.end);
  }

  /// Tests the point of a ball that is deepest in a solid that does not contain its centre, at the piece's start.
  void offerRound(const Piece& piece, const Isometry3d& X_start) {
    const Vector3d p_F = X_start * piece.corners[0];
    const Vector3d out = depthIn(solid_, p_F).out;
    const Vector3d into = out.squaredNorm() > 0.0 ? Vector3d(-out) : Vector3d(Vector3d::UnitX());
    const Vector3d x_F = p_F + piece.radius * into;
    offer(X_start.inverse() * x_F, x_F, piece.start);
  }

  void offer(const Vector3d& p_P, const Vector3d& p_F, double s) {
    const PartDepth depth = depthIn(solid_, p_F);
    if (!(depth.depth > search_.best_.depth) || isInside(p_P)) return;
    search_.best_ = {depth.depth, index_, s, p_F, depth.out};
  }

  /// Whether a point is inside the surface's own body by more than the resolution, so that it is not on its surface.
  bool isInside(const Vector3d& p_P) const {
    return !surface_.parts.empty() && depthIn(surface_.parts, p_P).depth > search_.resolution_;
  }

  DeepestSearch& search_;
  int index_;
  const AddedMotion& entry_;
  const EnteringSurface& surface_;
  const std::vector<SolidPart>& solid_;
  const TwoBodyMotion& motion_;
};

void DeepestSearch::restart(double resolution) {
  resolution_ = resolution;
  best_ = {};
  highest_left_ = 0.0;
  added_.clear();
  left_.clear();
}

void DeepestSearch::add(const EnteringSurface& surface, const std::vector<SolidPart>& solid,
                        const TwoBodyMotion& motion, double travel) {
  added_.push_back({surface, solid, motion, travel, {motion.X_FP(0.0), motion.X_FP(0.5), motion.X_FP(1.0)}});
}

/// Keeps the piece if it may contain a deeper point than the deepest known one.
void DeepestSearch::push(const Piece& piece) {
  if (isDone(piece.bound)) {
    highest_left_ = std::max(highest_left_, piece.bound);
    return;
  }
  left_.push_back(piece);
  std::push_heap(left_.begin(), left_.end(), isLess);
}

void DeepestSearch::run(int max_pieces) {
  CancelTicks<64> cancel;
  for (int i = 0; i < static_cast<int>(added_.size()); ++i)
    MotionSearch(*this, i).offerBoxes(added_[i].surface.triangles->root().node);
  for (int pieces = 0; !left_.empty();) {
    cancel.check();
    std::pop_heap(left_.begin(), left_.end(), isLess);
    const Piece piece = left_.back();
    left_.pop_back();
    if (isDone(piece.bound) || pieces >= max_pieces) {
      // All other pieces have smaller bounds.
      highest_left_ = std::max(highest_left_, piece.bound);
      return;
    }
    MotionSearch search(*this, piece.motion);
    if (piece.node >= 0) {
      search.offerBoxes(piece.node);
    } else {
      ++pieces;
      search.divide(piece);
    }
  }
}

}  // namespace sdf_ccd
