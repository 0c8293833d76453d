#include "half_space_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sdf_ccd {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

const HalfSpace* halfSpaceOf(const BodyPart& part) {
  const Primitive* const primitive = part.field.primitive();
  return primitive ? std::get_if<HalfSpace>(primitive) : nullptr;
}

}  // namespace

bool isHalfSpace(const Body& body) {
  return body.parts.size() == 1 && halfSpaceOf(body.parts.front());
}

HalfSpacePatch::HalfSpacePatch(const Body& body) {
  const BodyPart& part = body.parts.front();
  const HalfSpace& half_space = *halfSpaceOf(part);
  const Vector3d& origin = part.X_BG.translation();
  half_space_.normal = (part.X_BG.linear() * half_space.normal).normalized();
  half_space_.offset = half_space.offset + half_space_.normal.dot(origin);
  offset_error_ = 16.0 * kEpsilon * (std::abs(half_space.offset) + origin.norm());
}

/// Centers lie on a square lattice, with cells as large as the larger one of the radius and the travel. A ball's foot
/// is then within 0.71 cells of a center, and the feet of all points within 2 cells of that.
void HalfSpacePatch::cover(const BoundingBall& ball, double travel) {
  constexpr double kSmallest = 1e-3;  // [m]
  constexpr double kInside = 3.0;     // radius of the circle in the triangle, in cells
  const double size = std::exp2(std::ceil(std::log2(std::max({ball.radius, travel, kSmallest}))));
  const Vector3d u = half_space_.normal.unitOrthogonal(), v = half_space_.normal.cross(u);
  const auto onLattice = [&](const Vector3d& axis) { return size * std::round(axis.dot(ball.center) / size) * axis; };
  const Vector3d center = half_space_.offset * half_space_.normal + onLattice(u) + onLattice(v);
  const double radius = 2.0 * kInside * size;  // of the circle through the corners
  if (size != size_) {
    const auto corner = [&](double angle) { return Vector3d(radius * (std::cos(angle) * u + std::sin(angle) * v)); };
    const double third = 2.0 * M_PI / 3.0;
    at_origin_.emplace(std::vector<RoundedTriangle>{{{corner(0.0), corner(third), corner(-third)}, 0.0}});
    tree_ = at_origin_;
    size_ = size;
  }
  tree_->displace(*at_origin_, center);
  deviation_ = offset_error_ + 16.0 * kEpsilon * (center.norm() + radius);
}

}  // namespace sdf_ccd
