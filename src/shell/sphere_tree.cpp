#include "common/cancel_point.h"
#include "shell/point_shell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sdf_ccd {
namespace {

// As many points are tested together in a vector as fast as the spheres of smaller nodes, which would take more memory
// than the points.
constexpr std::int32_t kPointsPerLeaf = 16;

class Builder {
 public:
  explicit Builder(const std::vector<Vector3d>& points) : points_(points), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  SphereTree build() {
    const CancelPoint cancel;
    SphereTree tree;
    if (points_.empty()) return tree;
    tree.nodes.push_back(node(0, static_cast<std::int32_t>(points_.size())));
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      cancel.check();
      const SphereTree::Node parent = tree.nodes[i];
      if (parent.end - parent.begin <= kPointsPerLeaf) continue;
      const std::int32_t middle = split(parent.begin, parent.end);
      tree.nodes[i].first_child = static_cast<std::int32_t>(tree.nodes.size());
      tree.nodes.push_back(node(parent.begin, middle));
      tree.nodes.push_back(node(middle, parent.end));
    }
    return tree;
  }

  const std::vector<std::int32_t>& order() const { return order_; }

 private:
  const Vector3d& point(std::int32_t i) const { return points_[order_[i]]; }

  SphereTree::Node node(std::int32_t begin, std::int32_t end) const {
    constexpr double kLargest = 1e38;  // beyond single precision
    const Vector3d exact = boundingBall(begin, end).center;
    const Vector3f center = exact.cwiseMax(-kLargest).cwiseMin(kLargest).cast<float>();
    const double radius = farthest(center.cast<double>(), begin, end).second;
    // Half a step more than necessary at least: distances computed elsewhere round differently.
    const float up = std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::infinity());
    return {center, radius > 0.0 ? up : 0.0F, begin, end, -1};
  }

  /// Halves the points along the longest side of their box; ties between equal coordinates are broken by the index.
  std::int32_t split(std::int32_t begin, std::int32_t end) {
    AlignedBox3d box;
    for (std::int32_t i = begin; i < end; ++i) box.extend(point(i));
    int axis;
    box.sizes().maxCoeff(&axis);
    const std::int32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::int32_t a, std::int32_t b) {
                       return points_[a][axis] != points_[b][axis] ? points_[a][axis] < points_[b][axis] : a < b;
                     });
    return middle;
  }

  /// The point farthest from p, and its distance.
  std::pair<std::int32_t, double> farthest(const Vector3d& p, std::int32_t begin, std::int32_t end) const {
    std::pair<std::int32_t, double> best{begin, -1};
    for (std::int32_t i = begin; i < end; ++i) {
      const double distance2 = (point(i) - p).squaredNorm();
      if (distance2 > best.second) best = {i, distance2};
    }
    best.second = std::sqrt(best.second);
    return best;
  }

  /// Starts from the smallest of three balls: about the box's centre, about the centroid, and that of Ritter 1990. Then
  /// moves the centre towards the farthest point in ever shorter steps (Bădoiu & Clarkson 2003); keeps the smallest.
  BoundingBall boundingBall(std::int32_t begin, std::int32_t end) const {
    AlignedBox3d box;
    Vector3d sum = Vector3d::Zero();
    for (std::int32_t i = begin; i < end; ++i) {
      box.extend(point(i));
      sum += point(i) - point(begin);
    }
    BoundingBall best{box.center(), farthest(box.center(), begin, end).second};
    for (const Vector3d& center : {Vector3d(point(begin) + sum / (end - begin)), ritterCenter(begin, end)}) {
      const double radius = farthest(center, begin, end).second;
      if (radius < best.radius) best = {center, radius};
    }
    constexpr int kSteps = 16;
    Vector3d center = best.center;
    for (int step = 1; step <= kSteps; ++step) {
      const auto [index, radius] = farthest(center, begin, end);
      if (radius < best.radius) best = {center, radius};
      center += (point(index) - center) / (step + 3);
    }
    return best;
  }

  Vector3d ritterCenter(std::int32_t begin, std::int32_t end) const {
    const Vector3d a = point(farthest(point(begin), begin, end).first);
    const Vector3d b = point(farthest(a, begin, end).first);
    BoundingBall ball{(a + b) / 2, (a - b).norm() / 2};
    for (std::int32_t i = begin; i < end; ++i) {
      const double distance = (point(i) - ball.center).norm();
      if (distance <= ball.radius) continue;
      const double radius = (ball.radius + distance) / 2;
      ball.center += (point(i) - ball.center) * ((distance - radius) / distance);
      ball.radius = radius;
    }
    return ball.center;
  }

  const std::vector<Vector3d>& points_;
  std::vector<std::int32_t> order_;
};

template <typename T>
void reorder(std::vector<T>& values, const std::vector<std::int32_t>& order) {
  if (values.size() != order.size()) return;  // a shell without areas or normals
  std::vector<T> result;
  result.reserve(values.size());
  for (const std::int32_t i : order) result.push_back(values[i]);
  values = std::move(result);
}

}  // namespace

SphereTree buildSphereTree(PointShell& shell) {
  const std::vector<Vector3d> points = shell.points();
  Builder builder(points);
  SphereTree tree = builder.build();
  const std::vector<std::int32_t> order = builder.order();
  reorder(shell.offsets, order);
  reorder(shell.normals, order);
  reorder(shell.areas, order);
  return tree;
}

}  // namespace sdf_ccd
