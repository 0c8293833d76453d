#include "body_half_space.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sdf_ccd {
namespace {

const HalfSpace* halfSpaceIn(const BodyPart& part) {
  const Primitive* const primitive = part.field.primitive();
  return primitive ? std::get_if<HalfSpace>(primitive) : nullptr;
}

}  // namespace

bool hasHalfSpace(const Body& body) {
  return std::any_of(body.parts.begin(), body.parts.end(), halfSpaceIn);
}

std::vector<BodyHalfSpace> halfSpacesOf(const Body& body) {
  std::vector<BodyHalfSpace> found;
  for (const BodyPart& part : body.parts) {
    const HalfSpace* const in_part = halfSpaceIn(part);
    if (!in_part) continue;
    const Vector3d& origin = part.X_BG.translation();
    const Vector3d normal = (part.X_BG.linear() * in_part->normal).normalized();
    const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * (std::abs(in_part->offset) + origin.norm());
    found.push_back({{normal, in_part->offset + normal.dot(origin)}, rounding});
  }
  return found;
}

}  // namespace sdf_ccd
