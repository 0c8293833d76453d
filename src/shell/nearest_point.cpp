#include "nearest_point.h"

#include <algorithm>
#include <array>

#include "common/infinity.h"

namespace sdf_ccd {
namespace {

constexpr std::int32_t kLeafSize = 6;
constexpr int kStackSize = 64;  // splits halve the count, so the tree is at most 31 deep

}  // namespace

NearestPoint::NearestPoint(const SampledPoints& shell) {
  const auto count = static_cast<std::int32_t>(shell.size());
  entries_.reserve(count);
  for (std::int32_t i = 0; i < count; ++i) entries_.push_back({shell.points[i], shell.normals[i].cast<double>(), i});
  if (count == 0) return;
  nodes_.push_back({{}, 0, count});
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const std::int32_t first = nodes_[i].first, size = nodes_[i].count;
    AlignedBox3d box;
    for (std::int32_t e = first; e < first + size; ++e) box.extend(entries_[e].point);
    nodes_[i].box = box;
    if (size <= kLeafSize) continue;
    int axis;
    box.sizes().maxCoeff(&axis);
    const std::int32_t half = size / 2;
    std::nth_element(entries_.begin() + first, entries_.begin() + first + half, entries_.begin() + first + size,
                     [axis](const Entry& a, const Entry& b) {
                       return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : a.index < b.index;
                     });
    nodes_[i].first = static_cast<std::int32_t>(nodes_.size());
    nodes_[i].count = 0;
    nodes_.push_back({{}, first, half});
    nodes_.push_back({{}, first + half, size - half});
  }
}

NearestPoint::Hit NearestPoint::find(const Vector3d& p, const Vector3d& facing) const {
  Hit best{-1, kInfinity, Vector3d::Zero()};
  if (nodes_.empty()) return best;
  struct Pending {
    double bound2;
    std::int32_t node;
  };
  std::array<Pending, kStackSize> stack;
  int size = 0;
  stack[size++] = {0, 0};
  while (size > 0) {
    const auto [bound2, index] = stack[--size];
    if (bound2 > best.distance2) continue;
    const Node& node = nodes_[index];
    if (node.count == 0) {
      Pending near{squaredDistance(nodes_[node.first].box, p), node.first};
      Pending far{squaredDistance(nodes_[node.first + 1].box, p), node.first + 1};
      if (far.bound2 < near.bound2) std::swap(near, far);
      if (far.bound2 <= best.distance2) stack[size++] = far;
      if (near.bound2 <= best.distance2) stack[size++] = near;
      continue;
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
      const Entry& entry = entries_[i];
      const double distance2 = (entry.point - p).squaredNorm();
      if (distance2 > best.distance2 || entry.normal.dot(facing) < 0) continue;
      if (distance2 < best.distance2 || entry.index < best.index) best = {entry.index, distance2, entry.point};
    }
  }
  return best;
}

}  // namespace sdf_ccd
