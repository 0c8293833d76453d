#include "sdf_ccd/body/body.h"

#include <algorithm>
#include <stdexcept>

namespace sdf_ccd {

const DistanceField& Body::field() const& {
  if (parts.size() == 1 && parts[0].X_BG.matrix() == Isometry3d::Identity().matrix()) return parts[0].field;
  throw std::logic_error("body " + name + " has " + std::to_string(parts.size()) +
                         " fields, or one in a frame of its own: see Body::parts");
}

BoundingBall motionBall(const Body& body) {
  if (body.ball.radius > 0.0) return body.ball;
  AlignedBox3d box_B;
  bool has_half_space = false;
  for (const BodyPart& part : body.parts) {
    const AlignedBox3d& box_G = part.field.surfaceBox();
    const bool is_bounded = box_G.min().allFinite() && box_G.max().allFinite();
    if (is_bounded) box_B.extend(box_G.transformed(part.X_BG));
    has_half_space |= !is_bounded;
  }
  if (has_half_space) {
    const double bounded = box_B.isEmpty() ? 0.0 : box_B.min().cwiseAbs().cwiseMax(box_B.max().cwiseAbs()).norm();
    return {Vector3d::Zero(), std::max(kHalfSpaceRadius, bounded)};
  }
  if (box_B.isEmpty()) return {};
  return {box_B.center(), 0.5 * box_B.diagonal().norm()};
}

}  // namespace sdf_ccd
