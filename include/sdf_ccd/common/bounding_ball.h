#pragma once

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A ball in frame P that holds the points of interest.
struct BoundingBall {
  Vector3d center = Vector3d::Zero();  ///< [m], frame P
  double radius = 0.0;                 ///< [m]
};

}  // namespace sdf_ccd
