#pragma once

#include <algorithm>
#include <array>

#include "depth_solid.h"

namespace sdf_ccd {

/// One value for each of a triangle's corners at the start of a motion, then at its end.
using HullValues = std::array<double, 6>;

/// The hull of these corners.
struct Hull {
  std::array<Vector3d, 6> corners;
  Vector3d center = Vector3d::Zero();
  double size = 0.0;  // no corner is farther from the center [m]
};

/// Upper bounds of the depth in a hull, each linear or convex between its corners, and their best weighted mean: it is
/// convex too, and with the best weights its largest value is the exact maximum of the smallest of linear bounds.
class HullBounds {
 public:
  /// @param hull  must outlive this.
  explicit HullBounds(const Hull& hull) : hull_(hull) {}

  const Hull& hull() const { return hull_; }

  /// The smallest upper bound [m].
  double value() const { return value_; }

  /// Shares of the corners in the place where it is attained, as far as the bounds tell.
  const HullValues& place() const { return place_; }

  /// Adds a bound by its values at the corners [m]. @param plane  whose it is, if it is linear.
  void add(const HullValues& values, const DepthPlane& plane = {});

  /// Adds what a plane tells. @return whether it holds in the whole hull.
  bool addPlane(const DepthPlane& plane);

  /// The planes of the largest weight.
  template <std::size_t n>
  void copyPlanes(std::array<DepthPlane, n>& planes) const {
    std::array<std::size_t, kMostBounds> order;
    for (std::size_t i = 0; i < count_; ++i) order[i] = i;
    std::sort(order.begin(), order.begin() + count_, [&](std::size_t i, std::size_t k) {
      const bool is_i = planes_[i].radius > 0.0, is_k = planes_[k].radius > 0.0;
      return is_i != is_k ? is_i : weights_[i] > weights_[k];
    });
    planes = {};
    for (std::size_t i = 0; i < std::min(n, count_); ++i) planes[i] = planes_[order[i]];
  }

 private:
  static constexpr std::size_t kMostBounds = 10;

  void findBestWeights();

  const Hull& hull_;
  std::array<HullValues, kMostBounds> bounds_;
  std::array<DepthPlane, kMostBounds> planes_;
  std::array<double, kMostBounds> weights_{};
  std::size_t count_ = 0;
  double value_ = kInfinity;
  HullValues place_{1.0, 0.0, 0.0, 0.0, 0.0, 0.0};
};

}  // namespace sdf_ccd
