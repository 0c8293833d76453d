#pragma once

#include <algorithm>
#include <cmath>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A cylinder around pieces of a surface. It is low if they are nearly flat: then, seen from far above, it bounds their
/// distance much more tightly than a box or a sphere does.
struct FlatCylinder {
  Vector3d center;
  Vector3d axis;           ///< unit; or zero: a sphere
  double radius = 0.0;     ///< [m]
  double half_height = 0;  ///< to each side of the centre [m]

  /// Enlarges it to contain a point, with a margin for rounding.
  void extend(const Vector3d& p) {
    const Vector3d offset = p - center;
    const double along = std::abs(axis.dot(offset));
    half_height = std::max(half_height, along * (1.0 + 1e-9));
    radius = std::max(radius, across(offset, along) * (1.0 + 1e-9));
  }

  /// False only if all of its points are certainly farther than `distance` from p.
  bool mayBeWithin(double distance, const Vector3d& p) const {
    const Vector3d offset = p - center;
    const double along = std::abs(axis.dot(offset));
    const double above = std::max(along - half_height, 0.0), beside = std::max(across(offset, along) - radius, 0.0);
    return above * above + beside * beside <= distance * distance * (1.0 + 1e-12);
  }

 private:
  static double across(const Vector3d& offset, double along) {
    return std::sqrt(std::max(offset.squaredNorm() - along * along, 0.0));
  }
};

}  // namespace sdf_ccd
