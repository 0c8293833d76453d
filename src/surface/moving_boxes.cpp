#include "moving_boxes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/infinity.h"
#include "mesh/triangle.h"

namespace sdf_ccd {
namespace {

using Floats = std::array<float, 3>;
using Rows = std::array<Floats, 3>;

Floats single(const Vector3d& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

Rows singleRows(const Matrix3d& m) {
  return {single(m.row(0)), single(m.row(1)), single(m.row(2))};
}

float dot(const Floats& a, const Floats& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Floats times(const Rows& m, const Floats& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}

Floats timesTransposed(const Rows& m, const Floats& v) {
  return {m[0][0] * v[0] + m[1][0] * v[1] + m[2][0] * v[2], m[0][1] * v[0] + m[1][1] * v[1] + m[2][1] * v[2],
          m[0][2] * v[0] + m[1][2] * v[1] + m[2][2] * v[2]};
}

Floats sum(const Floats& a, const Floats& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// The box of a slot, in its tree's own frame.
PlacedBox boxAt(const BoxTree& tree, BoxTree::Slot slot) {
  const BoxTree::Node& node = tree.node(slot.node);
  const int i = slot.lane;
  PlacedBox box;
  for (int k = 0; k < 3; ++k) {
    box.center[k] = node.center[k][i];
    box.half[k] = node.half[k][i];
    for (int j = 0; j < 3; ++j) box.axis[k][j] = node.axis[k][j][i];
  }
  box.radius = node.radius[i];
  box.reach = node.reach[i];
  return box;
}

/// The rotation halfway between two.
Matrix3d halfway(const Matrix3d& from, const Matrix3d& to) {
  Quaterniond q(from.transpose() * to);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  q.w() += q.norm();
  return (Quaterniond(from) * q.normalized()).normalized().toRotationMatrix();
}

/// Upper bound of a tree's extent along a direction; infinite if it exceeds the limit, or takes too many steps to find.
/// @param reachOf  returns an upper bound of a triangle's extent.
template <typename ReachOf>
double support(const BoxTree& tree, const Floats& direction, const MotionAlong& motion, double limit,
               const ReachOf& reachOf) {
  constexpr int kMaxBoxes = 96;
  constexpr double kNone = kInfinity;
  std::array<std::int32_t, kMaxBoxes> pending;
  int size = 0, visited = 0;
  double best = -kNone;
  pending[size++] = 0;
  while (size > 0) {
    const BoxTree::Node& node = tree.node(pending[--size]);
    BoxTree::Node::Lane supports;
    boxSupports(node, direction, motion, supports);
    for (int i = 0; i < node.count; ++i) {
      double reach = supports[i];
      if (!(reach <= limit)) {
        if (++visited == kMaxBoxes) return kNone;
        if (!BoxTree::isTriangle(node.below[i])) {
          pending[size++] = node.below[i];
          continue;
        }
        reach = reachOf(tree.triangle(BoxTree::triangleOf(node.below[i])));
        if (!(reach <= limit)) return kNone;
      }
      best = std::max(best, reach);
    }
  }
  return best;
}

/// Upper bound of a triangle's extent along a direction.
double reachAlong(const Vector3d& n, const Corners& t) {
  return std::max({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
}

/// Replaces gaps between a node's boxes and the box of a triangle by those of the triangle itself where these are
/// larger: a triangle fills no more than half of its box. Boxes larger than the triangle are left as they are.
/// @param triangle  from the origin of the node's tree.
void sharpen(const RoundedTriangle& triangle, float triangle_reach, const BoxTree::Node& node, const BoxMotion& motion,
             float cut, NearBoxes& found) {
  for (std::uint32_t near = found.near; near != 0; near &= near - 1) {
    const int i = __builtin_ctz(near);
    if (node.reach[i] > triangle_reach) continue;
    const Floats center = {node.center[0][i], node.center[1][i], node.center[2][i]};
    const Vector3d p(center[0], center[1], center[2]), away = p - closestOnTriangle(triangle.corners, p);
    const double distance = away.norm();
    if (!(distance > 0.0)) continue;
    const Vector3d n = away / distance;
    const Floats moved = sum(times(motion.turn, center), motion.shift);
    const double gap = n.dot(p) - reachAlong(n, triangle.corners) - triangle.radius - node.reach[i] -
                       std::abs(n.dot(Vector3d(moved[0], moved[1], moved[2]))) - motion.any -
                       motion.any_per_reach * node.reach[i];
    if (!(gap > found.gaps[i])) continue;
    found.gaps[i] = static_cast<float>(gap);
    if (!(found.gaps[i] > cut)) continue;
    found.near &= ~(std::uint32_t{1} << i);
    found.least_other = std::min(found.least_other, found.gaps[i]);
  }
}

/// The triangle of a box; empty if it has several.
std::optional<RoundedTriangle> onlyTriangle(const BoxTree& tree, BoxTree::Slot slot) {
  const std::int32_t below = tree.node(slot.node).below[slot.lane];
  if (!BoxTree::isTriangle(below)) return {};
  return tree.triangle(BoxTree::triangleOf(below));
}

}  // namespace

double coordinateSize(const BoxTree& a, const BoxTree& b, const EndPoses& poses) {
  return a.origin().norm() + a.ball().radius + (poses.X_AB_start * b.origin()).norm() +
         (poses.X_AB_end * b.origin()).norm() + b.origin().norm() + b.ball().radius;
}

MovingBoxes::MovingBoxes(const BoxTree& a, const BoxTree& b, const EndPoses& poses, double error)
    : a_(a), b_(b), poses_(poses), error_(error) {
  const Matrix3d R0 = poses.X_AB_start.linear(), R1 = poses.X_AB_end.linear(), R = halfway(R0, R1);
  const Vector3d at_start = poses.X_AB_start * b.origin(), at_end = poses.X_AB_end * b.origin();
  const Vector3d p_AB = 0.5 * (at_start + at_end) - a.origin();
  const Matrix3d difference = 0.5 * (R1 - R0);
  const Vector3d shift = 0.5 * (at_end - at_start);
  const double bend = (0.5 * (R0 + R1) - R).norm() * b.ball().radius;

  rounding_ = kBoxRounding * (a.ball().radius + b.ball().radius + p_AB.norm());
  R_middle_ = R;
  p_middle_ = p_AB;
  R_AB_ = singleRows(R);
  b_from_a_ = single(p_AB);
  a_from_b_ = single(-(R.transpose() * p_AB));
  difference_A_ = singleRows(difference);
  shift_A_ = single(shift);
  moving_ = {single(R.transpose() * shift), singleRows(R.transpose() * difference),
             static_cast<float>(error + bend + rounding_),
             static_cast<float>(std::sqrt(0.5) * (1.0 + 1e-6) * difference.norm())};
}

const PlacedBox& MovingBoxes::boxInA(BoxTree::Slot box_b) {
  PlacedBox& box = last_in_A_;
  if (box_b == last_b_) return box;
  last_b_ = box_b;
  box = boxAt(b_, box_b);
  box.center = sum(times(R_AB_, box.center), b_from_a_);
  for (Floats& axis : box.axis) axis = times(R_AB_, axis);
  return box;
}

const PlacedBox& MovingBoxes::boxInB(BoxTree::Slot box_a) {
  PlacedBox& box = last_in_B_;
  if (box_a == last_a_) return box;
  last_a_ = box_a;
  box = boxAt(a_, box_a);
  box.center = sum(timesTransposed(R_AB_, box.center), a_from_b_);
  for (Floats& axis : box.axis) axis = timesTransposed(R_AB_, axis);
  return box;
}

/// How far the ends of a box's half extents are displaced more than its center, A's axes.
Rows MovingBoxes::spreadInA(BoxTree::Slot box_b) const {
  const BoxTree::Node& node = b_.node(box_b.node);
  Rows spread;
  for (int k = 0; k < 3; ++k) {
    const float half = node.half[k][box_b.lane];
    const Floats along = {half * node.axis[k][0][box_b.lane], half * node.axis[k][1][box_b.lane],
                          half * node.axis[k][2][box_b.lane]};
    spread[k] = times(difference_A_, along);
  }
  return spread;
}

/// A triangle of B from A's origin.
Corners MovingBoxes::placedInA(const Corners& corners_B) const {
  Corners placed;
  for (int k = 0; k < 3; ++k) placed[k] = R_middle_ * (corners_B[k] - b_.origin()) + p_middle_;
  return placed;
}

/// A triangle of A from B's origin.
Corners MovingBoxes::placedInB(const Corners& corners_A) const {
  Corners placed;
  for (int k = 0; k < 3; ++k) placed[k] = R_middle_.transpose() * (corners_A[k] - a_.origin() - p_middle_);
  return placed;
}

void MovingBoxes::gapsInA(const BoxTree::Node& node, BoxTree::Slot box_b, float cut, NearBoxes& found) {
  const BoxTree::Node& of_b = b_.node(box_b.node);
  const Floats center = {of_b.center[0][box_b.lane], of_b.center[1][box_b.lane], of_b.center[2][box_b.lane]};
  BoxMotion motion{};
  motion.shift = sum(times(difference_A_, center), shift_A_);
  motion.any = moving_.any;
  BoxMotion in_any_direction = motion;
  in_any_direction.any += moving_.any_per_reach * of_b.reach[box_b.lane];
  if (!is_close_) return boxGaps(node, boxInA(box_b), direction_A_, in_any_direction, cut, found);
  directedBoxGaps(node, boxInA(box_b), direction_A_, motion, spreadInA(box_b), cut, found);
  if (found.near == 0) return;
  if (const auto triangle = onlyTriangle(b_, box_b))
    sharpen({placedInA(triangle->corners), triangle->radius}, of_b.reach[box_b.lane], node, in_any_direction, cut,
            found);
}

void MovingBoxes::gapsInB(const BoxTree::Node& node, BoxTree::Slot box_a, float cut, NearBoxes& found) {
  if (!is_close_) return boxGaps(node, boxInB(box_a), direction_B_, moving_, cut, found);
  directedBoxGaps(node, boxInB(box_a), direction_B_, moving_, cut, found);
  if (found.near == 0) return;
  if (const auto triangle = onlyTriangle(a_, box_a)) {
    const float reach = a_.node(box_a.node).reach[box_a.lane];
    sharpen({placedInB(triangle->corners), triangle->radius}, reach, node, moving_, cut, found);
  }
}

void MovingBoxes::setDirection(const Vector3d& n_A) {
  n_A_ = n_A;
  direction_A_ = single(n_A);
  direction_B_ = timesTransposed(R_AB_, direction_A_);
}

double MovingBoxes::supportA(double limit) const {
  const double from = n_A_.dot(a_.origin());
  return support(a_, direction_A_, {0.0F, {}, static_cast<float>(rounding_)}, limit,
                 [&](const RoundedTriangle& t) { return reachAlong(n_A_, t.corners) + t.radius - from; });
}

/// The errors of both are taken off here.
double MovingBoxes::supportB(double limit) const {
  const Floats against = {-direction_B_[0], -direction_B_[1], -direction_B_[2]};
  const double offset = -double(dot(direction_A_, b_from_a_));
  const Vector3d to_start = -(poses_.X_AB_start.linear().transpose() * n_A_),
                 to_end = -(poses_.X_AB_end.linear().transpose() * n_A_);
  const double from_start = n_A_.dot(a_.origin() - poses_.X_AB_start.translation()) - offset,
               from_end = n_A_.dot(a_.origin() - poses_.X_AB_end.translation()) - offset;
  // How far the middles of chords are from the boxes at the pose halfway, along the direction.
  const double bend = (0.5 * (to_start + to_end) + R_middle_.transpose() * n_A_).norm() * b_.ball().radius;
  const MotionAlong motion{dot(shift_A_, direction_A_), timesTransposed(difference_A_, direction_A_),
                           static_cast<float>(error_ + bend + rounding_)};
  return support(b_, against, motion, limit - offset,
                 [&](const RoundedTriangle& t) {
                   return std::max(reachAlong(to_start, t.corners) + from_start,
                                   reachAlong(to_end, t.corners) + from_end) +
                          t.radius + error_;
                 }) +
         offset;
}

}  // namespace sdf_ccd
