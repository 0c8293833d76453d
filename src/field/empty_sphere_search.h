#pragma once

#include <vector>

#include "common/lattice.h"
#include "field/empty_sphere.h"

namespace sdf_ccd {

/// Finds the empty spheres of a coarse grid's far cells from true distances on a lattice.
class EmptySphereSearch {
 public:
  /// The lattice: its points are the cells' centres or corners.
  enum class Lattice { kCenters, kCorners };

  /// @param size       cells per axis.
  /// @param distances  signed, at the lattice's points, x fastest; kCorners has one more than cells per axis [cells].
  EmptySphereSearch(Lattice lattice, const Vector3i& size, const std::vector<float>& distances);

  /// The sphere of a cell, which must lie entirely on one side of the surface.
  EmptySphere ball(const Vector3i& cell) const;

 private:
  float distance(const Vector3i& point) const { return distances_[indexIn(points_, point)]; }
  /// Of the lattice points that belong to a cell (its centre, or its corners) the one farthest from the surface.
  Vector3i farthest(const Vector3i& cell) const;
  /// The unit direction in which |φ| grows at a lattice point.
  Vector3d away(const Vector3i& point) const;

  Lattice lattice_;
  Vector3i points_;
  const std::vector<float>& distances_;
  double step_;
};

}  // namespace sdf_ccd
