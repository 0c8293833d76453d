#include "sdf_ccd/query/shell_query.h"

#include <algorithm>
#include <limits>

#include "sdf_ccd/query/segment_batch.h"

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

/// Points whose segments are asked together: grids answer batches faster.
class PointBatch {
 public:
  PointBatch(const DistanceField& field, double sigma, std::vector<ShellHit>& hits)
      : field_(field), options_{sigma}, hits_(hits) {
    segments_.clear();
    points_.clear();
  }

  void add(int point, int chord, const Segment& segment) {
    chord_ = chord;
    points_.push_back(point);
    segments_.push_back(segment);
    if (segments_.size() == kMost) ask();
  }

  void ask() {
    segmentIntervals(field_, segments_.data(), segments_.size(), options_, found_);
    for (const SegmentHit& hit : found_.hits) {
      hits_.push_back({points_[hit.segment], chord_, {double(hit.enter), double(hit.exit)}});
    }
    segments_.clear();
    points_.clear();
  }

 private:
  static constexpr std::size_t kMost = 16384;
  const DistanceField& field_;
  SegmentOptions options_;
  std::vector<ShellHit>& hits_;
  int chord_ = 0;
  // Kept by each thread, as above.
  static thread_local std::vector<Segment> segments_;
  static thread_local std::vector<int> points_;
  static thread_local BatchResult found_;
};

thread_local std::vector<Segment> PointBatch::segments_;
thread_local std::vector<int> PointBatch::points_;
thread_local BatchResult PointBatch::found_;

}  // namespace

void shellIntervals(const DistanceField& field, const PointShell& shell, const SphereTree& tree, const ChordPath& path,
                    const ShellQueryOptions& options, ShellQueryResult& result) {
  result.hits.clear();
  result.nodes_visited = 0;
  result.points_tested = 0;
  if (tree.nodes.empty()) return;
  // A point's roots are those of the interpolated field, the node's test is about the true distance.
  const double outside_margin = options.sigma + field.errorBound(), inside_margin = field.errorBound() - options.sigma;
  const SegmentOptions segment_options{options.sigma, options.any ? SegmentMode::kAny : SegmentMode::kAll};
  constexpr double kFarSweep = 4.0;  // radii
  constexpr std::int32_t kFewPoints = 16;
  const bool batched = !field.primitive() && !options.any;
  PointBatch batch(field, options.sigma, result.hits);
  thread_local Intervals intervals;
  std::vector<std::int32_t>& stack = nodeStack();
  for (std::size_t c = 0; c < path.chords.size(); ++c) {
    const Chord& chord = path.chords[c];
    const int chord_index = static_cast<int>(c);
    stack.push_back(0);
    while (!stack.empty()) {
      const SphereTree::Node& node = tree.nodes[stack.back()];
      stack.pop_back();
      ++result.nodes_visited;
      // Points run straight between the chord's ends, so a point stays within the radius of the centre's segment.
      const Segment center = along(chord, node.center);
      const SweptSide side = sweptSide(field, center, {node.radius + outside_margin, node.radius + inside_margin});
      if (side == SweptSide::kOutside) continue;
      if (side == SweptSide::kInside) {
        for (std::int32_t i = node.begin; i < node.end; ++i) {
          result.hits.push_back({i, chord_index, {0.0, 1.0}});
          if (options.any) return;
        }
        continue;
      }
      // A sphere's test costs as much as several points of a batch: not for few points, nor where spheres are swept far
      // and rarely miss what their parent meets.
      const bool few = batched && node.end - node.begin <= kFewPoints;
      const bool swept_far = batched && (center.end - center.start).norm() > kFarSweep * node.radius;
      if (node.first_child >= 0 && !few && !swept_far) {
        for (std::int32_t i = node.child_count; i-- > 0;) stack.push_back(node.first_child + i);
        continue;
      }
      result.points_tested += node.end - node.begin;
      for (std::int32_t i = node.begin; i < node.end; ++i) {
        const Segment segment = along(chord, shell.points[i]);
        if (batched) {
          batch.add(i, chord_index, segment);
          continue;
        }
        segmentIntervals(field, segment, segment_options, intervals);
        for (const Interval& interval : intervals) result.hits.push_back({i, chord_index, interval});
        if (options.any && !result.hits.empty()) return;
      }
    }
    if (batched) batch.ask();
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
