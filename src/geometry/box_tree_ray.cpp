#include "geometry/box_tree_ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/ray_directions.h"

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

  bool meetsAny(std::int32_t node_index) const {
    const BoxTree::Node& node = tree_.node(node_index);
    for (std::int32_t i = 0; i < node.count; ++i) {
      if (!meetsBox(node, i)) continue;
      const std::int32_t below = node.below[i];
      if (BoxTree::isTriangle(below) ? meets(tree_.triangle(BoxTree::triangleOf(below))) : meetsAny(below)) return true;
    }
    return false;
  }

 private:
  bool meetsBox(const BoxTree::Node& node, std::int32_t i) const {
    const auto at = [i](const std::array<BoxTree::Node::Lane, 3>& v) { return Vector3d(v[0][i], v[1][i], v[2][i]); };
    const Vector3d from_center = from_origin_ - at(node.center);
    double enter = 0.0, exit = std::numeric_limits<double>::infinity();
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

  /// A rounded triangle is convex and does not contain p, so the ray's line meets it either before p or after it: where
  /// the line is nearest to the triangle tells which.
  bool meets(const RoundedTriangle& triangle) const {
    std::array<Vector2d, 3> across;  // seen along the ray, which is at the origin
    std::array<double, 3> along;
    for (int k = 0; k < 3; ++k) {
      const Vector3d to = triangle.corners[k] - p_;
      across[k] = {u_.dot(to), v_.dot(to)};
      along[k] = along_.dot(to);
    }
    const double reach = triangle.radius + slack_;
    std::array<double, 3> areas;  // of the triangles between the ray and each side, twice
    for (int k = 0; k < 3; ++k) {
      const Vector2d &a = across[k], &b = across[(k + 1) % 3], side = b - a;
      areas[k] = a.x() * b.y() - a.y() * b.x();
      const double length2 = side.squaredNorm();
      const double share = length2 > 0.0 ? std::clamp(-a.dot(side) / length2, 0.0, 1.0) : 0.0;
      if ((a + share * side).norm() > reach) continue;
      if (along[k] + share * (along[(k + 1) % 3] - along[k]) > -slack_) return true;
    }
    const double area = areas[0] + areas[1] + areas[2];
    const bool is_inside =
        (areas[0] > 0.0 && areas[1] > 0.0 && areas[2] > 0.0) || (areas[0] < 0.0 && areas[1] < 0.0 && areas[2] < 0.0);
    if (!is_inside) return false;
    return (areas[1] * along[0] + areas[2] * along[1] + areas[0] * along[2]) / area > -slack_;
  }

  const BoxTree& tree_;
  const Vector3d p_, from_origin_, along_, u_, v_;
  const double slack_, box_slack_;
};

}  // namespace

bool seesOutside(const BoxTree& tree, const Vector3d& p) {
  for (int i = 0; i < kRayDirections; ++i)
    if (!Ray(tree, p, rayDirection(i)).meetsAny(tree.root().node)) return true;
  return false;
}

}  // namespace sdf_ccd
