#include "triangle_tree.h"

#include <cmath>

#include "box_measures.h"
#include "common/compiler_lanes.h"
#include "mesh/triangle.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

/// Three nodes of every quad on the way down wait on the stack; the builder keeps the depth below 96.
constexpr int kStackSize = 3 * 96 + 1;

/// Nodes nearer than this times their radius are opened whatever the bound: the remainder's bound requires this
/// distance.
constexpr double kMinAccuracy = 2.0;

struct Pending {
  double bound2;              ///< lower bound of the squared distance [m²]
  std::int32_t first, count;  ///< as in a quad
};

}  // namespace

TriangleTree::ClosestPoint TriangleTree::closestPoint(const Vector3d& p, double max_distance) const {
  ClosestPoint best{p, max_distance, -1};
  search(p, max_distance * max_distance, best);
  return best;
}

TriangleTree::ClosestPoint TriangleTree::closestPointNear(const Vector3d& p, int likely) const {
  const Vector3d q = triangles_[positions_[likely]].closest(p);
  const double distance2 = (q - p).squaredNorm();
  ClosestPoint best{q, std::sqrt(distance2), likely};
  search(p, distance2, best);
  return best;
}

SDF_CCD_INLINE void TriangleTree::leastDistances2(const Quad& quad, const Vector3d& p, double* least) {
  const Doubles zero = {};
  Doubles box2 = zero, center2 = zero, along = zero;
  for (int k = 0; k < 3; ++k) {
    const Doubles to_box = larger(larger(load(quad.low[k].data()) - p[k], p[k] - load(quad.high[k].data())), zero);
    const Doubles to_center = p[k] - load(quad.center[k].data());
    box2 += to_box * to_box;
    center2 += to_center * to_center;
    along += to_center * load(quad.axis[k].data());
  }
  const Doubles across = squareRoot(larger(center2 - along * along, zero));
  const Doubles above = larger(larger(along, -along) - load(quad.half_height.data()), zero);
  const Doubles beside = larger(across - load(quad.radius.data()), zero);
  store(larger(box2, (above * above + beside * beside) * (1.0 - 1e-12)), least);
}

/// Finds the closest point nearer than √best2.
SDF_CCD_LANES void TriangleTree::search(const Vector3d& p, double best2, ClosestPoint& best) const {
  std::array<Pending, kStackSize> stack;
  int size = 0;
  stack[size++] = {0.0, 0, nodes_[0].count};
  while (size > 0) {
    const auto [bound2, first, count] = stack[--size];
    if (bound2 >= best2) continue;
    if (count == 0) {
      const Quad& quad = quads_[first];
      std::array<double, 4> bounds2;
      leastDistances2(quad, p, bounds2.data());
      // The nearest on top of the stack, so that it is visited next.
      const int begin = size;
      for (int k = 0; k < 4; ++k) {
        if (bounds2[k] >= best2) continue;
        int at = size++;
        for (; at > begin && stack[at - 1].bound2 < bounds2[k]; --at) stack[at] = stack[at - 1];
        stack[at] = {bounds2[k], quad.first[k], quad.count[k]};
      }
      continue;
    }
    for (std::int32_t i = first; i < first + count; ++i) {
      if (!triangles_[i].mayBeWithin(best.distance, p)) continue;
      const Vector3d q = triangles_[i].closest(p);
      const double distance2 = (q - p).squaredNorm();
      if (distance2 < best2) {
        best2 = distance2;
        best = {q, std::sqrt(distance2), ids_[i]};
      }
    }
  }
}

void TriangleTree::trianglesWithin(const Vector3d& p, double radius, std::vector<int>& triangles) const {
  triangles.clear();
  const double radius2 = radius * radius;
  std::array<std::int32_t, kStackSize> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (squaredDistance(node.box, p) > radius2) continue;
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      if (!triangles_[i].mayBeWithin(radius, p)) continue;
      const Vector3d q = triangles_[i].closest(p);
      if ((q - p).squaredNorm() <= radius2) triangles.push_back(ids_[i]);
    }
  }
}

double TriangleTree::farthestAlong(const Vector3d& n, const Vector3d& p, double radius, double limit) const {
  struct Pending {
    double farthest;  // upper bound
    std::int32_t node;
  };
  const auto pendingAt = [&](std::int32_t index) {
    const AlignedBox3d& box = nodes_[index].box;
    return Pending{n.cwiseProduct(box.min() - p).cwiseMax(n.cwiseProduct(box.max() - p)).sum(), index};
  };
  const double radius2 = radius * radius;
  double farthest = -radius;
  std::array<Pending, kStackSize> stack;
  int size = 0;
  stack[size++] = pendingAt(0);
  while (size > 0) {
    const Pending pending = stack[--size];
    const Node& node = nodes_[pending.node];
    if (pending.farthest <= farthest || squaredDistance(node.box, p) > radius2) continue;
    if (node.count == 0) {
      stack[size++] = pendingAt(node.first);
      stack[size++] = pendingAt(node.first + 1);
      if (stack[size - 2].farthest > stack[size - 1].farthest) std::swap(stack[size - 2], stack[size - 1]);
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      double along = farthest;
      for (const Vector3d& corner : triangles_[i].corners()) along = std::max(along, n.dot(corner - p));
      if (!(along > farthest && triangles_[i].mayBeWithin(radius, p))) continue;
      if ((triangles_[i].closest(p) - p).squaredNorm() > radius2) continue;
      farthest = along;
      if (farthest > limit) return farthest;
    }
  }
  return farthest;
}

TriangleTree::BoundedNumber TriangleTree::boundedNumber(const Vector3d& p, double accuracy, double bound) const {
  const double accuracy2 = accuracy * accuracy;
  BoundedNumber sum;
  SolidAngleSum near(p);
  std::array<std::int32_t, kStackSize> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::int32_t index = stack[--size];
    ++sum.visited;
    const Vector3d r = expansions_[index].center - p;
    const double distance2 = r.squaredNorm();
    if (distance2 > accuracy2 * expansions_[index].radius2) {
      const BoundedNumber part = evaluate(expansions_[index], r, distance2);
      if (part.error <= bound) {
        sum.value += part.value;
        sum.error += part.error;
        continue;
      }
    }
    const Node& node = nodes_[index];
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    sum.visited += static_cast<std::size_t>(node.count);
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) near.add(triangles_[i].corners());
  }
  sum.value += near.value();
  return sum;
}

double TriangleTree::windingNumber(const Vector3d& p, double accuracy) const {
  return boundedNumber(p, accuracy, kInfinity).value;
}

bool TriangleTree::inside(const Vector3d& p, Inside rule, std::size_t* visited) const {
  constexpr double kRounding = 1e-6;
  // Near an open mesh, bounds below one half decide; a little more accuracy mostly meets them at once.
  const double accuracy = rule == Inside::kAboveHalf ? 2.5 : kMinAccuracy;
  BoundedNumber number;
  for (const double bound : {kInfinity, 5e-3, 5e-4, 5e-5, 0.0}) {
    number = boundedNumber(p, accuracy, bound);
    if (visited) *visited += number.visited;
    const double error = number.error + kRounding;
    if (rule == Inside::kAboveHalf) {
      if (std::abs(number.value - 0.5) > error) break;
      continue;
    }
    // Integers within the error of the sum: if zero alone, or only others, they decide. If none, p is on the surface.
    const double size = std::abs(number.value);
    const bool may_be_zero = size <= error;
    const bool may_be_other = std::abs(size - std::max(std::round(size), 1.0)) <= error;
    if (may_be_zero != may_be_other) return may_be_other;
    if (!may_be_zero) break;
  }
  return (rule == Inside::kNotZero ? std::abs(number.value) : number.value) > 0.5;
}

}  // namespace sdf_ccd
