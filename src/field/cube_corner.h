#pragma once

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Corner k of a unit cube, and octant k of one of side two: bit 0 of k is x, bit 1 y, bit 2 z.
inline Vector3i cubeCorner(int k) {
  return {k & 1, (k >> 1) & 1, k >> 2};
}

}  // namespace sdf_ccd
