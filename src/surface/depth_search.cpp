#include "depth_search.h"

#include <algorithm>
#include <cmath>

#include "common/cancel_point.h"
#include "hull_bounds.h"
#include "mesh/triangle.h"

namespace sdf_ccd {

/// The search over one motion.
class DepthSearch::Step {
 public:
  Step(DepthSearch& search, const TwoBodyMotion& motion, double travel, DeepestPoint& best)
      : search_(search),
        surface_(*search.surface_),
        solid_(*search.solid_),
        motion_(motion),
        travel_(travel),
        best_(best),
        greatest_(search.solid_->greatestDepth()),
        X_GP_{poseOf(0.0), poseOf(0.5), poseOf(1.0)} {}

  bool isImproved() const { return improved_; }

  /// Whether a piece was left out, so that the next search has to begin anew.
  bool losesPieces() const { return loses_pieces_; }

  /// Pushes the boxes of a node over a part of the motion.
  void offerBoxes(int node_index, double start, double end) {
    const BoxTree::Node& node = surface_.node(node_index);
    for (int i = 0; i < node.count; ++i) {
      Piece piece;
      piece.start = start;
      piece.end = end;
      piece.corners.fill(surface_.origin() + Vector3d(node.center[0][i], node.center[1][i], node.center[2][i]));
      piece.radius = node.reach[i];
      piece.node = node.below[i];
      piece.is_box = true;
      add(piece);
    }
  }

  void examine(Piece piece) {
    if (piece.step != search_.step_) {
      if (piece.end < 1.0) return;  // the part of an earlier motion that came before its end
      piece.start = 0.0;
      return add(piece);
    }
    if (!piece.is_box) return divide(piece);
    if (0.5 * travelIn(piece) > piece.radius) {
      Piece second = piece;
      piece.end = second.start = 0.5 * (piece.start + piece.end);
      add(piece);
      return add(second);
    }
    if (!BoxTree::isTriangle(piece.node)) return offerBoxes(piece.node, piece.start, piece.end);
    const int index = BoxTree::triangleOf(piece.node);
    const RoundedTriangle triangle = surface_.triangle(index);
    piece.is_box = false;
    piece.corners = triangle.corners;
    piece.radius = triangle.radius;
    piece.ball = triangle.radius > 0.0 ? index : -1;
    add(piece);
  }

 private:
  Isometry3d poseOf(double s) const { return solid_.X_BG().inverse() * motion_.X_FP(s); }

  Isometry3d poseAt(double s) const {
    const double halves = 2.0 * s;
    return halves == std::floor(halves) ? X_GP_[static_cast<std::size_t>(halves)] : poseOf(s);
  }

  double sufficientBound() const { return best_.depth + search_.resolution_; }
  bool isDone(double bound) const { return bound <= sufficientBound(); }

  /// @return whether the bound suffices.
  bool tighten(double bound, Piece& piece) const {
    piece.bound = std::min(piece.bound, bound);
    return isDone(piece.bound);
  }

  /// Tightens a piece's bound and keeps the piece.
  void add(Piece piece) {
    if (!tighten(greatest_, piece)) piece.is_box ? measureBox(piece) : measure(piece);
    piece.step = search_.step_;
    search_.push(piece);
  }

  /// No part of a motion is more than twice as fast as the whole (see relativeMotionBounds()).
  double travelIn(const Piece& piece) const { return std::min(1.0, 2.0 * (piece.end - piece.start)) * travel_; }

  void measureBox(Piece& piece) {
    // All points stay within half of the travel of their positions halfway.
    const Vector3d center = poseAt(0.5 * (piece.start + piece.end)) * piece.corners[0];
    const double reach = piece.radius + 0.5 * travelIn(piece);
    if (tighten(reach - solid_.distanceBound(center), piece)) return;
    const PointDepth depth = solid_.at(center, piece.nearest);
    piece.nearest = depth.triangle;
    tighten(depth.depth + reach, piece);
  }

  void measure(Piece& piece) {
    const Isometry3d X_start = poseAt(piece.start), X_end = poseAt(piece.end);
    Hull hull;
    for (int k = 0; k < 3; ++k) {
      hull.corners[k] = X_start * piece.corners[k];
      hull.corners[k + 3] = X_end * piece.corners[k];
      hull.center += (hull.corners[k] + hull.corners[k + 3]) / 6.0;
    }
    for (const Vector3d& corner : hull.corners) hull.size = std::max(hull.size, (corner - hull.center).norm());
    const double length = piece.end - piece.start;
    const double beyond = motion_.acceleration * length * length / 8.0 + piece.radius;
    HullBounds bounds(hull);
    if (isWholeBall(piece) && solid_.radius() > 0.0) {
      offerRound(piece, X_start, X_end);
      tighten(ballInBall(X_start * piece.corners[0], X_end * piece.corners[0], beyond - piece.radius, piece.radius),
              piece);
      return;
    }
    for (const DepthPlane& plane : piece.planes) {
      if (!bounds.addPlane(plane)) continue;
      if (tighten(bounds.value() + beyond, piece)) return;
    }
    const PointDepth center = solid_.at(hull.center, piece.nearest);
    piece.nearest = center.triangle;
    if (tighten(center.depth + hull.size + beyond, piece)) return;
    addSide(center, center, bounds);
    constexpr int kRounds = 5;
    for (int round = 0; round < kRounds && !tighten(bounds.value() + beyond, piece); ++round) {
      // Where the bound is highest, another side may be nearer.
      const double before = bounds.value();
      const PointDepth there = offerPlace(piece, bounds, X_start, X_end);
      if (isDone(piece.bound)) break;
      addSide(there, center, bounds);
      if (!(bounds.value() < before - 0.1 * search_.resolution_)) break;
    }
    if (isWholeBall(piece) && !tighten(bounds.value() + beyond, piece)) {
      offerRound(piece, X_start, X_end);
    }
    bounds.copyPlanes(piece.planes);
  }

  /// Adds what the surface nearest to a point tells.
  void addSide(const PointDepth& side, const PointDepth& center, HullBounds& bounds) const {
    constexpr double kParallel = 1.0 - 1e-9;
    const Hull& hull = bounds.hull();
    const auto addPlane = [&](const Vector3d& normal, int triangle) {
      return bounds.addPlane(solid_.planeAlong(normal, triangle, hull.center, hull.size, center));
    };
    if (side.triangle < 0) {
      addPlane(side.out, -1);
      return;
    }
    const Vector3d normal = solid_.normalOf(side.triangle);
    if (!addPlane(normal, side.triangle)) {
      HullValues distances;
      for (int k = 0; k < 6; ++k) distances[k] = solid_.distanceTo(side.triangle, hull.corners[k]);
      bounds.add(distances);
    }
    if (!(normal.dot(side.out) > kParallel)) addPlane(side.out, -1);
  }

  /// Measures the point at which the bound is attained.
  PointDepth offerPlace(const Piece& piece, const HullBounds& bounds, const Isometry3d& X_start,
                        const Isometry3d& X_end) {
    const HullValues& shares = bounds.place();
    const bool at_end = shares[3] + shares[4] + shares[5] >= 0.5;
    Vector3d p_P = Vector3d::Zero();
    for (int k = 0; k < 3; ++k) p_P += (shares[k] + shares[k + 3]) * piece.corners[k];
    if (isWholeBall(piece)) return solid_.at((at_end ? X_end : X_start) * p_P, piece.nearest);  // not on its surface
    if (piece.ball >= 0) p_P = ontoBall(piece.ball, p_P);
    const Vector3d p_G = (at_end ? X_end : X_start) * p_P;
    const PointDepth depth = solid_.at(p_G, piece.nearest);
    offer(depth, p_P, p_G, at_end ? piece.end : piece.start);
    return depth;
  }

  /// Measures the point of a ball that is deepest in a solid that does not contain its centre, at both ends.
  void offerRound(const Piece& piece, const Isometry3d& X_start, const Isometry3d& X_end) {
    for (const bool at_end : {false, true}) {
      const Isometry3d& X_GP = at_end ? X_end : X_start;
      const Vector3d center = X_GP * piece.corners[0];
      const Vector3d p_G = center - piece.radius * solid_.at(center, piece.nearest).out;
      offer(solid_.at(p_G, piece.nearest), X_GP.inverse() * p_G, p_G, at_end ? piece.end : piece.start);
    }
  }

  /// Upper bound of the depth of a ball's surface in a ball about the origin, along a path that deviates from its chord
  /// by no more than `bend`: its nearest point to the origin is at the difference of the radius and the distance.
  double ballInBall(const Vector3d& start, const Vector3d& end, double bend, double radius) const {
    const double nearest = closestOnSegment(start, end, Vector3d::Zero()).norm() - bend;
    const double farthest = std::max(start.norm(), end.norm()) + bend;
    return solid_.radius() - std::max({0.0, nearest - radius, radius - farthest});
  }

  void offer(const PointDepth& depth, const Vector3d& p_P, const Vector3d& p_G, double s) {
    if (!(depth.depth > best_.depth)) return;
    best_ = {depth.depth, s, p_P, p_G, depth.out};
    improved_ = true;
  }

  /// Halves a piece in time or along its longest edge, whichever extends farther.
  void divide(const Piece& piece) {
    const Isometry3d X_start = poseAt(piece.start), X_end = poseAt(piece.end);
    const double length = piece.end - piece.start;
    double displacement = motion_.acceleration * length * length / 8.0, longest = -1.0;
    int edge = 0;
    for (int k = 0; k < 3; ++k) {
      displacement = std::max(displacement, (X_end * piece.corners[k] - X_start * piece.corners[k]).norm());
      const double side = (piece.corners[(k + 1) % 3] - piece.corners[k]).norm();
      if (side > longest) edge = k;
      longest = std::max(longest, side);
    }
    if (isWholeBall(piece) && displacement <= piece.radius && !(solid_.radius() > 0.0)) return divideBall(piece);
    // A resting point cannot be divided further.
    const bool is_short = length < 1e-9;
    if (longest == 0.0 && (displacement == 0.0 || is_short)) {
      search_.highest_ = std::max(search_.highest_, piece.bound);
      loses_pieces_ = true;
      return;
    }
    Piece first = piece, second = piece;
    if (displacement > longest && !is_short) {
      first.end = second.start = 0.5 * (piece.start + piece.end);
    } else {
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

  RoundedTriangle ballOf(int index) const { return surface_.triangle(index); }

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

  DepthSearch& search_;
  const BoxTree& surface_;
  const DepthSolid& solid_;
  const TwoBodyMotion& motion_;
  const double travel_;
  DeepestPoint& best_;
  const double greatest_;
  bool improved_ = false, loses_pieces_ = false;
  const std::array<Isometry3d, 3> X_GP_;  // at the start, halfway and at the end
};

void DepthSearch::restart() {
  pieces_.clear();
  free_.clear();
  left_.clear();
  displaced_ = 0.0;
  is_complete_ = false;
}

void DepthSearch::begin(double displacement) {
  constexpr double kFar = 0.25;  // of the surface's size: other parts of it are deepest then
  displaced_ += displacement;
  if (!is_complete_ || !(displaced_ < kFar * surface_->ball().radius)) restart();
  highest_ = 0.0;
}

DeepestPoint DepthSearch::pointAt(const Vector3d& p_P, const TwoBodyMotion& motion, double s) const {
  const Vector3d p_G = solid_->X_BG().inverse() * (motion.X_FP(s) * p_P);
  const PointDepth depth = solid_->at(p_G);
  return {depth.depth, s, p_P, p_G, depth.out};
}

void DepthSearch::push(const Piece& piece) {
  int index = static_cast<int>(pieces_.size());
  if (free_.empty()) {
    pieces_.push_back(piece);
  } else {
    index = free_.back();
    free_.pop_back();
    pieces_[static_cast<std::size_t>(index)] = piece;
  }
  left_.push_back({piece.bound - displaced_, index});
  std::push_heap(left_.begin(), left_.end());
}

DepthSearch::Piece DepthSearch::pop() {
  std::pop_heap(left_.begin(), left_.end());
  const Kept kept = left_.back();
  left_.pop_back();
  free_.push_back(kept.piece);
  Piece piece = pieces_[static_cast<std::size_t>(kept.piece)];
  piece.bound = kept.key + displaced_;
  return piece;
}

bool DepthSearch::run(const TwoBodyMotion& motion, double travel, DeepestPoint& best, int& pieces) {
  const bool is_new = !is_complete_;
  if (is_new) restart();
  displaced_ += travel;
  const auto bound = [&] { return left_.empty() ? 0.0 : left_.front().key + displaced_; };
  is_complete_ = false;  // until the end: a search that is cancelled loses a piece
  bool loses_pieces = false;
  ++step_;
  bool improved = false;
  if (is_new || bound() > best.depth + resolution_) {
    Step step(*this, motion, travel, best);
    if (is_new) step.offerBoxes(surface_->root().node, 0.0, 1.0);
    CancelTicks<64> cancel;
    for (; bound() > best.depth + resolution_ && pieces > 0; --pieces) {
      cancel.check();
      step.examine(pop());
    }
    improved = step.isImproved();
    loses_pieces = step.losesPieces();
  }
  highest_ = std::max(highest_, bound());
  is_complete_ = !loses_pieces;
  return improved;
}

}  // namespace sdf_ccd
