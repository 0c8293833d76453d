#include "exact_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sdf_ccd::precision {
namespace {

constexpr double kEdge = 1e-12;  // tolerance of barycentric coordinates

/// Parameter t at which the line start + t direction crosses a triangle (Möller & Trumbore 1997).
std::optional<double> crossing(const Vector3d& start, const Vector3d& direction, const Corners& triangle) {
  const Vector3d ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0];
  const Vector3d h = direction.cross(ac);
  const double determinant = ab.dot(h);
  if (determinant == 0.0) return std::nullopt;
  const Vector3d s = (start - triangle[0]) / determinant;
  const double u = s.dot(h);
  if (u < -kEdge || u > 1.0 + kEdge) return std::nullopt;
  const Vector3d q = s.cross(ab);
  const double v = direction.dot(q);
  if (v < -kEdge || u + v > 1.0 + kEdge) return std::nullopt;
  return ac.dot(q);
}

}  // namespace

ExactSurface::ExactSurface(const TriangleMesh& mesh)
    : surface_(mesh), near_(0.01 * boundingBox(mesh).diagonal().norm()) {}

std::optional<double> ExactSurface::firstHit(const Segment& segment) const {
  const Vector3d direction = segment.end - segment.start;
  const double length = direction.norm();
  thread_local std::vector<int> nearby;
  for (double at = 0.0; length > 0.0 && at <= 1.0;) {
    const double free = unsignedDistance(segment.start + at * direction);
    if (free > near_) {
      at += (1.0 - 1e-9) * free / length;  // less, so that rounding cannot step over a surface hit head-on
      continue;
    }
    const double end = std::min(at + 2.0 * near_ / length, 1.0), middle = 0.5 * (at + end);
    surface_.tree().trianglesWithin(segment.start + middle * direction, 1.001 * (middle - at) * length, nearby);
    std::optional<double> first;
    for (const int i : nearby) {
      const std::optional<double> hit = crossing(segment.start, direction, cornersOf(mesh(), i));
      if (hit && *hit >= at && *hit <= end && (!first || *hit < *first)) first = hit;
    }
    if (first || end == 1.0) return first;
    at = end;
  }
  return std::nullopt;
}

}  // namespace sdf_ccd::precision
