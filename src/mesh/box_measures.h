#pragma once

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Half of the area of a box's surface.
inline double halfArea(const AlignedBox3d& box) {
  const Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

/// The largest absolute coordinate of a box's points.
inline double largestCoordinate(const AlignedBox3d& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

/// Squared distance of p from a box; 0 inside. Without branches, other than Eigen's.
inline double squaredDistance(const AlignedBox3d& box, const Vector3d& p) {
  return (box.min() - p).cwiseMax(p - box.max()).cwiseMax(0).squaredNorm();
}

}  // namespace sdf_ccd
