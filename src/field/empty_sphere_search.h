#pragma once

#include <vector>

#include "field/empty_sphere.h"

namespace sdf_ccd {

/// Finds the balls of a coarse grid's far cells from true distances on a lattice.
class EmptySphereSearch {
 public:
  /// Where a cell's own place is.
  enum class Lattice { kCenters, kCorners };

  /// @param size       cells per axis.
  /// @param distances  signed, at the lattice's places, x fastest; kCorners has one more than cells per axis [cells].
  EmptySphereSearch(Lattice lattice, const Vector3i& size, const std::vector<float>& distances);

  /// Of a cell that all lies on one side of the surface.
  EmptySphere ball(const Vector3i& cell) const;

 private:
  float distance(const Vector3i& place) const {
    return distances_[(std::size_t(place.z()) * places_.y() + place.y()) * places_.x() + place.x()];
  }
  /// Of the points next to a cell's centre the farthest from the surface.
  Vector3i farthest(const Vector3i& cell) const;
  /// Out of the surface, or into it: away from it.
  Vector3d away(const Vector3i& place) const;

  Lattice lattice_;
  Vector3i places_;
  const std::vector<float>& distances_;
  double step_;
};

}  // namespace sdf_ccd
