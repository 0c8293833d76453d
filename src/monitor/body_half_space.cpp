#include "body_half_space.h"

#include <cmath>
#include <limits>

namespace sdf_ccd {

bool isHalfSpace(const Body& body) {
  if (body.parts.size() != 1) return false;
  const Primitive* const primitive = body.parts.front().field.primitive();
  return primitive && isHalfSpace(*primitive);
}

BodyHalfSpace halfSpaceOf(const Body& body) {
  const BodyPart& part = body.parts.front();
  const HalfSpace& in_part = std::get<HalfSpace>(*part.field.primitive());
  const Vector3d& origin = part.X_BG.translation();
  const Vector3d normal = (part.X_BG.linear() * in_part.normal).normalized();
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * (std::abs(in_part.offset) + origin.norm());
  return {{normal, in_part.offset + normal.dot(origin)}, rounding};
}

}  // namespace sdf_ccd
