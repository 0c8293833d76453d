#include "box_tree_ray.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/infinity.h"
#include "mesh/ray_directions.h"

namespace sdf_ccd {
namespace {

using Vector2d = Eigen::Vector2d;

class Ray {
 public:
  Ray(const BoxTree& tree, const Vector3d& p, const Vector3d& direction)
      : tree_(tree),
        p_(p),
        from_origin_(p - tree.origin()),
        along_(direction),
        u_(direction.unitOrthogonal()),
        v_(direction.cross(u_)),
        slack_(2.0 * kRayCracks * tree.ball().radius),
        box_slack_(slack_ + kBoxRounding * (tree.ball().radius + from_origin_.norm())) {}

  /// Adds the crossings of the triangles below a node. @return false if the ray passes an edge too closely.
  template <class Filter>
  bool count(std::int32_t node_index, const Filter& belongs, int& winding) const {
    const BoxTree::Node& node = tree_.node(node_index);
    for (std::int32_t i = 0; i < node.count; ++i) {
      if (!meetsBox(node, i)) continue;
      const std::int32_t below = node.below[i];
      if (!BoxTree::isTriangle(below)) {
        if (!count(below, belongs, winding)) return false;
        continue;
      }
      const int index = BoxTree::triangleOf(below);
      const RoundedTriangle& triangle = tree_.triangle(index);
      if (triangle.radius > 0.0 || !belongs(index)) continue;
      const std::optional<int> crossing = cross(triangle.corners);
      if (!crossing) return false;
      winding += *crossing;
    }
    return true;
  }

 private:
  bool meetsBox(const BoxTree::Node& node, std::int32_t i) const {
    const auto at = [i](const std::array<BoxTree::Node::Lane, 3>& v) { return Vector3d(v[0][i], v[1][i], v[2][i]); };
    const Vector3d from_center = from_origin_ - at(node.center);
    double enter = 0.0, exit = kInfinity;
    for (int k = 0; k < 3; ++k) {
      const Vector3d axis = at(node.axis[k]);
      const double start = axis.dot(from_center), speed = axis.dot(along_);
      const double half = node.half[k][i] + node.radius[i] + box_slack_;
      if (speed == 0.0) {
        if (std::abs(start) > half) return false;
        continue;
      }
      const double a = (-half - start) / speed, b = (half - start) / speed;
      enter = std::max(enter, std::min(a, b));
      exit = std::min(exit, std::max(a, b));
    }
    return enter <= exit * (1.0 + 1e-12);
  }

  /// 1 where the ray leaves through the triangle's front, -1 where it enters, 0 if it does not meet it; nothing if that
  /// is not certain.
  std::optional<int> cross(const Corners& corners) const {
    std::array<Vector2d, 3> across;  // seen along the ray, which is at the origin
    bool is_behind = true;
    for (int k = 0; k < 3; ++k) {
      const Vector3d to = corners[k] - p_;
      across[k] = {u_.dot(to), v_.dot(to)};
      is_behind &= along_.dot(to) < -slack_;
    }
    if (is_behind) return 0;
    int left = 0, right = 0;  // sides that have the ray on that side
    for (int k = 0; k < 3; ++k) {
      const Vector2d &a = across[k], &b = across[(k + 1) % 3], side = b - a;
      const double length2 = side.squaredNorm();
      const double share = length2 > 0.0 ? std::clamp(-a.dot(side) / length2, 0.0, 1.0) : 0.0;
      if ((a + share * side).squaredNorm() <= slack_ * slack_) return std::nullopt;
      // The line of a side is at least as far from a point inside as the triangle's border is.
      const double area = a.x() * b.y() - a.y() * b.x(), sure = 0.5 * slack_ * std::sqrt(length2);
      left += area > sure;
      right += area < -sure;
    }
    if (left < 3 && right < 3) return 0;
    // No side is near, so the triangle is no sliver, and its normal is accurate.
    constexpr double kRounding = 1e-9;
    const Vector3d normal = areaNormal(corners).normalized();
    const double height = normal.dot(p_ - corners[0]);
    if (std::abs(height) <= kRounding * tree_.ball().radius) return std::nullopt;
    if ((height > 0.0) == (left == 3)) return 0;  // behind p
    return left == 3 ? 1 : -1;
  }

  const BoxTree& tree_;
  const Vector3d p_, from_origin_, along_, u_, v_;
  const double slack_, box_slack_;
};

}  // namespace

std::optional<int> windingNumber(const BoxTree& tree, const Vector3d& p, const std::function<bool(int)>& belongs) {
  for (int i = 0; i < kRayDirections; ++i) {
    int winding = 0;
    if (Ray(tree, p, rayDirection(i)).count(tree.root().node, belongs, winding)) return winding;
  }
  return std::nullopt;
}

}  // namespace sdf_ccd
