#include "box_tree.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <Eigen/Eigenvalues>

#include "common/cancel_point.h"
#include "mesh/binned_split.h"
#include "mesh/point_numbers.h"

namespace sdf_ccd {
namespace {

using Axes = std::array<Vector3d, 3>;

/// Area moments of a surface's triangles, for its principal axes.
struct Moments {
  double area = 0.0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();

  void add(const Corners& t) {
    const double area2 = areaNormal(t).norm();
    const Vector3d sum = t[0] + t[1] + t[2];
    area += area2;
    first += area2 / 3.0 * sum;
    second += area2 / 12.0 *
              (sum * sum.transpose() + t[0] * t[0].transpose() + t[1] * t[1].transpose() + t[2] * t[2].transpose());
  }
};

/// Axes of a triangle's box: its normal first, its longest edge last.
Axes axesOf(const Corners& t) {
  Vector3d along = t[1] - t[0];
  for (const Vector3d& edge : {Vector3d(t[2] - t[1]), Vector3d(t[0] - t[2])})
    if (edge.squaredNorm() > along.squaredNorm()) along = edge;
  if (!(along.squaredNorm() > 0.0)) return {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  along.normalize();
  Vector3d normal = areaNormal(t);
  normal -= normal.dot(along) * along;
  if (!(normal.squaredNorm() > 0.0)) normal = along.unitOrthogonal();
  normal.normalize();
  return {normal, normal.cross(along).normalized(), along};
}

}  // namespace

/// Builds top-down: boxes along principal axes, split by the surface area heuristic over bins (Wald 2007).
class BoxTree::Builder {
 public:
  Builder(BoxTree& tree, const std::vector<RoundedTriangle>& triangles) : tree_(tree), triangles_(triangles) {}

  void build() {
    const int count = static_cast<int>(triangles_.size());
    for (const RoundedTriangle& t : triangles_) centers_.push_back(centroid(t.corners));
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0);
    AlignedBox3d all;
    for (const RoundedTriangle& t : triangles_)
      for (const Vector3d& p : t.corners) all.extend(p);
    tree_.origin_ = all.center();

    std::vector<Range> pending = {rangeOf(0, count, 0)};  // of each node
    tree_.nodes_.emplace_back();
    fill(pending, 0, pending);
    for (std::size_t node = 1; node < tree_.nodes_.size(); ++node) {
      cancel_.check();
      fill(divide(pending[node]), node, pending);
    }
    storeTriangles();
    tree_.ball_.center = tree_.origin_;
    tree_.ball_.radius = 0.0;
    for (const RoundedTriangle& t : triangles_)
      for (const Vector3d& p : t.corners)
        tree_.ball_.radius = std::max(tree_.ball_.radius, (p - tree_.origin_).norm() + t.radius);
  }

  /// After build(): the index that each triangle had before.
  const std::vector<int>& order() const { return order_; }

 private:
  /// Triangles that are consecutive in `order_`, and the box along their principal axes, from the tree's origin.
  struct Range {
    int begin, end;
    int depth;
    Axes axes;
    AlignedBox3d box;
    int size() const { return end - begin; }
  };

  Range rangeOf(int begin, int end, int depth) const {
    Range range{begin, end, depth, {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}, {}};
    if (range.size() == 1) range.axes = axesOf(at(begin).corners);
    range.box = extent(range, range.axes);
    if (range.size() > 1) align(range);
    return range;
  }

  const RoundedTriangle& at(int i) const { return triangles_[order_[i]]; }

  AlignedBox3d extent(const Range& range, const Axes& axes) const {
    AlignedBox3d box;
    for (int i = range.begin; i < range.end; ++i)
      for (const Vector3d& p : at(i).corners) {
        const Vector3d q = p - tree_.origin_;
        box.extend(Vector3d(axes[0].dot(q), axes[1].dot(q), axes[2].dot(q)));
      }
    return box;
  }

  /// Turns the box to the principal axes, if it is smaller there.
  void align(Range& range) const {
    Moments moments;
    for (int i = range.begin; i < range.end; ++i) {
      Corners t = at(i).corners;
      for (Vector3d& p : t) p -= tree_.origin_;
      moments.add(t);
    }
    if (!(moments.area > 0.0)) return;
    const Vector3d mean = moments.first / moments.area;
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(moments.second / moments.area - mean * mean.transpose());
    const Axes main = {solver.eigenvectors().col(0).normalized(), solver.eigenvectors().col(1).normalized(),
                       solver.eigenvectors().col(0).cross(solver.eigenvectors().col(1)).normalized()};
    if (!main[0].allFinite() || !main[1].allFinite() || !main[2].allFinite()) return;
    const AlignedBox3d box = extent(range, main);
    if (!(halfArea(box) < halfArea(range.box))) return;
    range.axes = main;
    range.box = box;
  }

  /// Writes the ranges' boxes into a node, and appends nodes for ranges of several triangles.
  void fill(std::vector<Range> ranges, std::size_t index, std::vector<Range>& pending) {
    Node node{};
    node.count = static_cast<std::int32_t>(ranges.size());
    node.radius.fill(-1e30F);
    for (int lane = 0; lane < node.count; ++lane) {
      const Range& range = ranges[lane];
      setBox(range, lane, node);
      if (range.size() == 1) {
        node.below[lane] = ~range.begin;
        continue;
      }
      node.below[lane] = static_cast<std::int32_t>(tree_.nodes_.size());
      tree_.nodes_.emplace_back();
      pending.push_back(range);
    }
    tree_.nodes_[index] = node;
  }

  void setBox(const Range& range, int lane, Node& node) const {
    Axes axes = range.axes;
    Vector3d middle = range.box.center();
    int flattest;
    range.box.sizes().minCoeff(&flattest);
    std::swap(axes[0], axes[flattest]);
    std::swap(middle[0], middle[flattest]);
    const Vector3d center = middle[0] * axes[0] + middle[1] * axes[1] + middle[2] * axes[2];
    double radius = 0.0, reach = 0.0;
    Vector3d half = Vector3d::Zero();
    for (int i = range.begin; i < range.end; ++i) {
      for (const Vector3d& p : at(i).corners) {
        const Vector3d q = p - tree_.origin_ - center;
        for (int k = 0; k < 3; ++k) half[k] = std::max(half[k], std::abs(axes[k].dot(q)));
        reach = std::max(reach, q.norm());
      }
      radius = std::max(radius, at(i).radius);
    }
    // Twice the displacement of a point by rounding the centre and the axes to single precision.
    const double rounding = (center.norm() + reach) / (1 << 23);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) node.axis[i][k][lane] = static_cast<float>(axes[i][k]);
      node.center[i][lane] = static_cast<float>(center[i]);
      node.half[i][lane] = roundedUp(half[i] + rounding);
    }
    node.radius[lane] = roundedUp(radius);
    node.reach[lane] = roundedUp(reach + radius + rounding);
  }

  static float roundedUp(double value) { return value > 0.0 ? static_cast<float>(value * (1.0 + 2e-7)) : 0.0F; }

  /// Splits a range into at most eight parts, the largest first. Parts that fit into one node are not split, unless the
  /// whole range fits into one.
  std::vector<Range> divide(const Range& range) {
    least_ = range.size() > Node::kWidth ? Node::kWidth : 1;
    std::vector<Range> parts = {range};
    std::vector<double> areas = {1.0};
    while (parts.size() < static_cast<std::size_t>(Node::kWidth)) {
      const std::size_t largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
      if (areas[largest] < 0.0) break;
      const auto [first, second] = split(parts[largest]);
      parts[largest] = first;
      parts.push_back(second);
      areas[largest] = weight(first);
      areas.push_back(weight(second));
    }
    return parts;
  }

  double weight(const Range& range) const { return range.size() <= least_ ? -1.0 : halfArea(range.box); }

  std::pair<Range, Range> split(const Range& range) {
    const Axes& axes = range.axes;
    int axis = 0;
    double low = 0.0, size = -1.0;
    for (int k = 0; k < 3; ++k) {
      double least = 1e300, most = -1e300;
      for (int i = range.begin; i < range.end; ++i) {
        const double x = axes[k].dot(centers_[order_[i]]);
        least = std::min(least, x);
        most = std::max(most, x);
      }
      if (most - least > size) size = most - least, low = least, axis = k;
    }
    const auto begin = order_.begin() + range.begin, end = order_.begin() + range.end;
    const auto coordinate = [&](int id) { return axes[axis].dot(centers_[id]); };
    const int bin = size > 0.0 && range.depth < kHeuristicDepth ? bestBin(range, axes, axis, low, kBins / size) : 0;
    auto middle = begin + range.size() / 2;
    if (range.size() <= Node::kWidth * Node::kWidth && range.size() > Node::kWidth) {
      const std::ptrdiff_t half = range.size() / 2;
      middle = begin + (half + Node::kWidth - 1) / Node::kWidth * Node::kWidth;
      std::nth_element(begin, middle, end, [&](int a, int b) { return coordinate(a) < coordinate(b); });
    } else if (bin > 0) {
      middle = std::partition(begin, end, [&](int id) { return binOf(coordinate(id), low, kBins / size) < bin; });
    } else {
      std::nth_element(begin, middle, end, [&](int a, int b) { return coordinate(a) < coordinate(b); });
    }
    const int at = static_cast<int>(middle - order_.begin());
    return {rangeOf(range.begin, at, range.depth + 1), rangeOf(at, range.end, range.depth + 1)};
  }

  static int binOf(double x, double low, double scale) {
    return std::clamp(static_cast<int>((x - low) * scale), 0, kBins - 1);
  }

  /// The split with the lowest cost; 0 if there is none.
  int bestBin(const Range& range, const Axes& axes, int axis, double low, double scale) const {
    Bins bins;
    for (int i = range.begin; i < range.end; ++i) {
      const int bin = binOf(axes[axis].dot(centers_[order_[i]]), low, scale);
      ++bins.counts[bin];
      for (const Vector3d& p : at(i).corners)
        bins.boxes[bin].extend(Vector3d(axes[0].dot(p), axes[1].dot(p), axes[2].dot(p)));
    }
    return bins.bestSplit();
  }

  void storeTriangles() {
    PointNumbers corners(triangles_.size() / 2);
    tree_.triangles_.reserve(order_.size());
    for (const int id : order_) {
      const Corners& t = triangles_[id].corners;
      tree_.triangles_.push_back({corners.numberOf(t[0]), corners.numberOf(t[1]), corners.numberOf(t[2])});
    }
    tree_.corners_ = std::move(corners.points);
    tree_.corners_.shrink_to_fit();
    const auto is_round = [](const RoundedTriangle& t) { return t.radius > 0.0; };
    if (std::none_of(triangles_.begin(), triangles_.end(), is_round)) return;
    for (const int id : order_) tree_.radii_.push_back(triangles_[id].radius);
  }

  const CancelPoint cancel_;
  BoxTree& tree_;
  const std::vector<RoundedTriangle>& triangles_;
  std::vector<Vector3d> centers_;
  std::vector<int> order_;
  int least_ = 1;  ///< ranges of at most this many triangles are not split
};

BoxTree::BoxTree(const std::vector<RoundedTriangle>& triangles, std::vector<int>* order) {
  if (triangles.empty()) throw std::invalid_argument("box tree: no triangles");
  Builder builder(*this, triangles);
  builder.build();
  if (order) *order = builder.order();
}

/// Boxes are relative to the origin.
void BoxTree::displace(const BoxTree& original, const Vector3d& displacement) {
  for (std::size_t i = 0; i < corners_.size(); ++i) corners_[i] = original.corners_[i] + displacement;
  origin_ = original.origin_ + displacement;
  ball_.center = original.ball_.center + displacement;
}

}  // namespace sdf_ccd
