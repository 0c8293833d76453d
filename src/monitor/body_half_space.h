#pragma once

#include <vector>

#include "sdf_ccd/body/body.h"

namespace sdf_ccd {

/// Whether the body has a half-space, alone or beside bounded elements.
bool hasHalfSpace(const Body& body);

/// A body's half-space, in the body's frame.
struct BodyHalfSpace {
  HalfSpace half_space;
  double deviation;  ///< upper bound of its displacement by rounding [m]
};

/// All of them.
std::vector<BodyHalfSpace> halfSpacesOf(const Body& body);

}  // namespace sdf_ccd
