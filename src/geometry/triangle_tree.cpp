#include "sdf_ccd/geometry/triangle_tree.h"

#include <cmath>
#include <utility>

#include "sdf_ccd/geometry/triangle.h"

namespace sdf_ccd {
namespace {

/// One child of every node on the way down waits on the stack; the builder keeps the depth below 96.
constexpr int kStackSize = 128;

struct Pending {
  double bound2;  ///< squared distance to the node's box
  std::int32_t node;
};

double squaredDistance(const AlignedBox3d& box, const Vector3d& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0).squaredNorm();
}

}  // namespace

TriangleTree::ClosestPoint TriangleTree::closestPoint(const Vector3d& p, double max_distance) const {
  ClosestPoint best{p, max_distance, -1};
  search(p, max_distance * max_distance, best);
  return best;
}

TriangleTree::ClosestPoint TriangleTree::closestPointNear(const Vector3d& p, int likely) const {
  const Vector3d q = triangles_[places_[likely]].closest(p);
  const double distance2 = (q - p).squaredNorm();
  ClosestPoint best{q, std::sqrt(distance2), likely};
  search(p, distance2, best);
  return best;
}

/// Looks for what is nearer than √best2.
void TriangleTree::search(const Vector3d& p, double best2, ClosestPoint& best) const {
  std::array<Pending, kStackSize> stack;
  int size = 0;
  stack[size++] = {squaredDistance(nodes_[0].box, p), 0};
  while (size > 0) {
    const auto [bound2, index] = stack[--size];
    if (bound2 >= best2) continue;
    const Node& node = nodes_[index];
    if (node.count == 0) {
      double near2 = squaredDistance(nodes_[node.first].box, p);
      double far2 = squaredDistance(nodes_[node.first + 1].box, p);
      std::int32_t near = node.first, far = node.first + 1;
      if (far2 < near2) {
        std::swap(near, far);
        std::swap(near2, far2);
      }
      if (far2 < best2) stack[size++] = {far2, far};
      if (near2 < best2) stack[size++] = {near2, near};
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
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

double TriangleTree::windingNumber(const Vector3d& p, double accuracy) const {
  const double accuracy2 = accuracy * accuracy;
  double sum = 0;
  std::array<std::int32_t, kStackSize> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::int32_t index = stack[--size];
    const Vector3d r = expansions_[index].center - p;
    const double distance2 = r.squaredNorm();
    if (distance2 > accuracy2 * expansions_[index].radius2) {
      sum += evaluate(expansions_[index], r, distance2);
      continue;
    }
    const Node& node = nodes_[index];
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      sum += solidAngleFraction(triangles_[i].a(), triangles_[i].b(), triangles_[i].c(), p);
    }
  }
  return sum;
}

}  // namespace sdf_ccd
