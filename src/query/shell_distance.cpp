#include "query/shell_distance.h"

#include <algorithm>

#include "common/infinity.h"

namespace sdf_ccd {

ShellDistance shellDistance(const DistanceField& field, const PointShell& shell, const SphereTree& tree,
                            const Isometry3d& X_FP, double max_distance, std::vector<int>& pending) {
  ShellDistance nearest;
  nearest.value = kInfinity;
  double low = kInfinity;  // lower bound of the distances of the points examined
  const auto cut = [&] { return std::min(max_distance, nearest.value); };
  pending.clear();
  if (!tree.nodes.empty()) pending.push_back(0);
  while (!pending.empty()) {
    const SphereTree::Node& node = tree.nodes[static_cast<std::size_t>(pending.back())];
    pending.pop_back();
    if (field.lowerBound(X_FP * node.ball().center) - node.radius > cut()) continue;
    if (!node.isLeaf()) {
      const int first = node.first_child, second = first + 1;
      // The last one is examined next: the one whose centre is nearest.
      const auto bound = [&](int child) { return field.lowerBound(X_FP * tree.nodes[child].ball().center); };
      const int near = bound(second) < bound(first) ? second : first;
      pending.push_back(near == first ? second : first);
      pending.push_back(near);
      continue;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const Vector3d p_F = X_FP * shell.point(static_cast<std::size_t>(i));
      if (field.lowerBound(p_F) > cut()) continue;
      const FieldSample sample = field.sample(p_F);
      low = std::min(low, sample.value - sample.error);
      if (sample.value >= nearest.value) continue;
      nearest = {i, sample.value, sample.error, p_F, sample.gradient};
    }
  }
  if (nearest.point < 0 || low > max_distance) return {};
  // Another point with a larger error may in truth be nearer. Points that were skipped, as their lower bound exceeded
  // the value, cannot be.
  nearest.error = std::max(nearest.error, nearest.value - low);
  return nearest;
}

}  // namespace sdf_ccd
