#pragma once

#include "sdf_ccd/body/body.h"

namespace sdf_ccd {

/// Whether the body is a single half-space.
bool isHalfSpace(const Body& body);

/// A body's half-space, in the body's frame.
struct BodyHalfSpace {
  HalfSpace half_space;
  double deviation;  ///< upper bound of its displacement by rounding [m]
};

/// @param body  must satisfy isHalfSpace().
BodyHalfSpace halfSpaceOf(const Body& body);

}  // namespace sdf_ccd
