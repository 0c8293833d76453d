#pragma once

#include <random>

#include "sdf_ccd/types.h"

/// Repeatable random inputs.
namespace sdf_ccd::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return low + (high - low) * (double(random() >> 11) * 0x1.0p-53);
}

inline Vector3d uniformIn(Random& random, const AlignedBox3d& box) {
  Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = uniform(random, box.min()[k], box.max()[k]);
  return p;
}

/// In the cube around the origin whose sides are 2 `half_side` long.
inline Vector3d pointInCube(Random& random, double half_side) {
  return uniformIn(random, {Vector3d::Constant(-half_side), Vector3d::Constant(half_side)});
}

inline Vector3d direction(Random& random) {
  for (;;) {
    const Vector3d v = pointInCube(random, 1.0);
    if (v.squaredNorm() > 1e-4 && v.squaredNorm() <= 1.0) return v.normalized();
  }
}

/// A pose with rotations up to `angle` [rad] and translations up to `distance` [m].
inline Isometry3d pose(Random& random, double angle, double distance) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(uniform(random, -angle, angle), direction(random)).toRotationMatrix();
  X.translation() = uniform(random, 0, distance) * direction(random);
  return X;
}

}  // namespace sdf_ccd::test
