#pragma once

#include <cmath>
#include <cstdint>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A unit vector in four bytes: its projection onto the octahedron |x| + |y| + |z| = 1, unfolded to a square, with 16
/// bits per coordinate.
///
/// Source: Cigolle et al. 2014, A survey of efficient representations for independent unit vectors (oct32).
/// Guarantee: vector() deviates from the vector that was packed by at most kMaxError; the axes' directions are exact.
struct PackedNormal {
  /// The angle [rad]. Rounding displaces a point of the octahedron by at most (δ, δ, 2δ), δ = 1/65534. All of it is
  /// outside the ball of radius 1/√3 about the origin, and projecting onto a ball increases no distance: the unit
  /// vectors differ by at most √3 · √6 δ.
  static constexpr double kMaxError = 6.5e-5;

  std::int16_t u = 0, v = 0;  ///< of the square, ±32767 at its sides; +z is its center

  PackedNormal() = default;
  /// @param n  of any length; one that is zero or not finite gives +z.
  explicit PackedNormal(const Vector3d& n);

  /// The unit vector.
  Vector3d vector() const {
    constexpr double kUnit = 1.0 / 32767.0;
    const double x = kUnit * u, y = kUnit * v, z = 1.0 - std::abs(x) - std::abs(y);
    const double folded = z < 0.0 ? -z : 0.0;  // the lower half's corners, which are outside |x| + |y| = 1
    return Vector3d(x - std::copysign(folded, x), y - std::copysign(folded, y), z).normalized();
  }
};

}  // namespace sdf_ccd
