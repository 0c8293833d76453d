#pragma once

#include <cmath>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Directions of rays that search a way out of a surface. They lie on a spiral from pole to pole in steps of the golden
/// angle, which covers the sphere evenly; successive ones are very different.
constexpr int kRayDirections = 128;
inline Vector3d rayDirection(int i) {
  constexpr double kGoldenAngle = 2.39996322972865332;
  const int k = 37 * i % kRayDirections;
  const double z = (2 * k + 1.0) / kRayDirections - 1.0, radius = std::sqrt(1.0 - z * z), angle = kGoldenAngle * k;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// A ray passes a triangle if it stays farther from it than this share of the surface's size, so that none escapes
/// through cracks that conformingMesh() closes.
constexpr double kRayCracks = 4e-6;

}  // namespace sdf_ccd
