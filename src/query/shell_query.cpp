#include "sdf_ccd/query/shell_query.h"

#include <algorithm>
#include <limits>

namespace sdf_ccd {
namespace {

/// Nodes still to visit; kept by each thread so that steady-state queries allocate nothing.
std::vector<std::int32_t>& nodeStack() {
  thread_local std::vector<std::int32_t> stack;
  stack.clear();
  return stack;
}

Segment along(const Chord& chord, const Vector3d& p_P) {
  return {chord.X_FP_start * p_P, chord.X_FP_end * p_P};
}

}  // namespace

void shellIntervals(const DistanceField& field, const PointShell& shell, const SphereTree& tree, const ChordPath& path,
                    const ShellQueryOptions& options, ShellQueryResult& result) {
  result.hits.clear();
  result.nodes_visited = 0;
  result.points_tested = 0;
  if (tree.nodes.empty()) return;
  // A point's roots are those of the interpolated field, the node's test is about the true distance.
  const double margin = options.sigma + field.errorBound();
  const SegmentOptions segment_options{options.sigma, options.any};
  thread_local Intervals intervals;
  std::vector<std::int32_t>& stack = nodeStack();
  for (std::size_t c = 0; c < path.chords.size(); ++c) {
    const Chord& chord = path.chords[c];
    stack.push_back(0);
    while (!stack.empty()) {
      const SphereTree::Node& node = tree.nodes[stack.back()];
      stack.pop_back();
      ++result.nodes_visited;
      // Points run straight between the chord's ends, so a point stays within the radius of the centre's segment.
      if (!mayTouch(field, along(chord, node.center), node.radius + margin)) continue;
      if (node.first_child >= 0) {
        for (std::int32_t i = node.child_count; i-- > 0;) stack.push_back(node.first_child + i);
        continue;
      }
      for (std::int32_t i = node.begin; i < node.end; ++i) {
        ++result.points_tested;
        segmentIntervals(field, along(chord, shell.points[i]), segment_options, intervals);
        for (const Interval& interval : intervals) result.hits.push_back({i, static_cast<int>(c), interval});
        if (options.any && !result.hits.empty()) return;
      }
    }
  }
}

double clearance(const DistanceField& field, const SphereTree& tree, const PointShell& shell, const Isometry3d& X_FP,
                 double slack) {
  double nearest = std::numeric_limits<double>::infinity();  // of the points seen
  double bound = nearest;                                    // of all points
  if (tree.nodes.empty()) return bound;
  std::vector<std::int32_t>& stack = nodeStack();
  stack.push_back(0);
  while (!stack.empty()) {
    const SphereTree::Node& node = tree.nodes[stack.back()];
    stack.pop_back();
    const double low = field.lowerBound(X_FP * node.center) - node.radius;
    if (low >= nearest - slack) {
      bound = std::min(bound, low);
      continue;
    }
    if (node.first_child >= 0) {
      for (std::int32_t i = node.child_count; i-- > 0;) stack.push_back(node.first_child + i);
      continue;
    }
    for (std::int32_t i = node.begin; i < node.end; ++i) {
      nearest = std::min(nearest, field.lowerBound(X_FP * shell.points[i]));
    }
  }
  return std::min(bound, nearest);
}

}  // namespace sdf_ccd
