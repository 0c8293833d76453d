#include "moving_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// As it is in its own frame.
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

/// The rotation halfway from one to another.
Matrix3d halfway(const Matrix3d& from, const Matrix3d& to) {
  Quaterniond q(from.transpose() * to);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  q.w() += q.norm();
  return (Quaterniond(from) * q.normalized()).normalized().toRotationMatrix();
}

/// The largest of a node's supports, or of what is in it; infinite if one is above the limit. @param along  the tree.
double support(const BoxTree& tree, const Floats& direction, const BoxMotion& motion, double limit) {
  constexpr int kMostNodes = 64;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::array<std::int32_t, kMostNodes> pending;
  int size = 0, visited = 0;
  double best = -kNone;
  pending[size++] = 0;
  while (size > 0) {
    const BoxTree::Node& node = tree.node(pending[--size]);
    BoxTree::Node::Lane supports;
    boxSupports(node, direction, motion, supports);
    for (int i = 0; i < node.count; ++i) {
      if (supports[i] <= limit) {
        best = std::max(best, double(supports[i]));
        continue;
      }
      if (BoxTree::isTriangle(node.below[i]) || ++visited == kMostNodes) return kNone;
      pending[size++] = node.below[i];
    }
  }
  return best;
}

}  // namespace

MovingBoxes::MovingBoxes(const BoxTree& a, const BoxTree& b, const EndPoses& poses, double error) : a_(a), b_(b) {
  const Matrix3d R0 = poses.X_AB_start.linear(), R1 = poses.X_AB_end.linear(), R = halfway(R0, R1);
  const Vector3d at_start = poses.X_AB_start * b.origin(), at_end = poses.X_AB_end * b.origin();
  p_AB_ = 0.5 * (at_start + at_end) - a.origin();
  const Matrix3d turn = 0.5 * (R1 - R0);
  const Vector3d shift = 0.5 * (at_end - at_start);
  const double rounding = kBoxRounding * (a.ball().radius + b.ball().radius + p_AB_.norm());
  const double bend = (0.5 * (R0 + R1) - R).norm() * b.ball().radius;

  R_AB_ = singleRows(R);
  b_from_a_ = single(p_AB_);
  a_from_b_ = single(-(R.transpose() * p_AB_));
  turn_A_ = singleRows(turn);
  shift_A_ = single(shift);
  still_ = {};
  still_.any = static_cast<float>(error + bend + rounding);
  moving_ = {single(R.transpose() * shift), singleRows(R.transpose() * turn), still_.any,
             static_cast<float>(std::sqrt(0.5) * (1.0 + 1e-6) * turn.norm())};
}

PlacedBox MovingBoxes::boxInA(BoxTree::Slot box_b) const {
  PlacedBox box = boxAt(b_, box_b);
  box.center = sum(times(R_AB_, box.center), b_from_a_);
  for (Floats& axis : box.axis) axis = times(R_AB_, axis);
  return box;
}

PlacedBox MovingBoxes::boxInB(BoxTree::Slot box_a) const {
  PlacedBox box = boxAt(a_, box_a);
  box.center = sum(timesTransposed(R_AB_, box.center), a_from_b_);
  for (Floats& axis : box.axis) axis = timesTransposed(R_AB_, axis);
  return box;
}

void MovingBoxes::gapsInA(const BoxTree::Node& node, BoxTree::Slot box_b, BoxTree::Node::Lane& gaps) const {
  const BoxTree::Node& of_b = b_.node(box_b.node);
  const Floats center = {of_b.center[0][box_b.lane], of_b.center[1][box_b.lane], of_b.center[2][box_b.lane]};
  BoxMotion motion{};
  motion.shift = sum(times(turn_A_, center), shift_A_);
  motion.any = moving_.any + moving_.any_per_reach * of_b.reach[box_b.lane];
  boxGaps(node, boxInA(box_b), direction_A_, motion, gaps);
}

void MovingBoxes::gapsInB(const BoxTree::Node& node, BoxTree::Slot box_a, BoxTree::Node::Lane& gaps) const {
  boxGaps(node, boxInB(box_a), direction_B_, moving_, gaps);
}

void MovingBoxes::setDirection(const Vector3d& n_A) {
  direction_A_ = single(n_A);
  direction_B_ = timesTransposed(R_AB_, direction_A_);
}

double MovingBoxes::supportA(double limit) const {
  return support(a_, direction_A_, still_, limit);
}

double MovingBoxes::supportB(double limit) const {
  const Floats against = {-direction_B_[0], -direction_B_[1], -direction_B_[2]};
  const double offset = -double(dot(direction_A_, b_from_a_));
  return support(b_, against, moving_, limit - offset) + offset;
}

}  // namespace sdf_ccd
