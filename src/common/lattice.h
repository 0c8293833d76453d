#pragma once

#include <cstddef>

#include "sdf_ccd/types.h"

/// Boxes of points of the integer lattice, in the order x fastest, then y, then z.
namespace sdf_ccd {

/// Index of a point among those from the origin to before `end`.
inline std::size_t indexIn(const Vector3i& end, const Vector3i& p) {
  return (std::size_t(p.z()) * std::size_t(end.y()) + std::size_t(p.y())) * std::size_t(end.x()) + std::size_t(p.x());
}

/// The point with an index.
inline Vector3i pointIn(const Vector3i& end, std::size_t index) {
  const std::size_t x = std::size_t(end.x()), row = index / x, y = std::size_t(end.y());
  return {int(index % x), int(row % y), int(row / y)};
}

/// Calls visit(p) for the points from `begin` to before `end`.
template <typename Visit>
void forEachPoint(const Vector3i& begin, const Vector3i& end, Visit visit) {
  for (Vector3i p = begin; p.z() < end.z(); ++p.z())
    for (p.y() = begin.y(); p.y() < end.y(); ++p.y())
      for (p.x() = begin.x(); p.x() < end.x(); ++p.x()) visit(p);
}

template <typename Visit>
void forEachPoint(const Vector3i& end, Visit visit) {
  forEachPoint(Vector3i::Zero(), end, visit);
}

}  // namespace sdf_ccd
