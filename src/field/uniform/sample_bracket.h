#pragma once

#include <optional>

#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {

/// What exact samples around a point say of the distance there [m].
///
/// The distance is 1-Lipschitz, so that φ(q) − |p−q| ≤ φ(p) ≤ φ(q) + |p−q| for every sample q. That is sharp where q
/// lies on the shortest way from p to the surface, or on its continuation: along it the distance changes by |p−q|. A
/// sample beside that line by δ at a distance R from p is off by about δ²/2R. Hence those that lie nearest to the line,
/// one per layer of samples, as far as there are any: a few thousandths of a cell where the surface is smooth, against
/// the √3/2 that hold for any 1-Lipschitz function.
/// @param p_F       within the grid's box.
/// @param gradient  of the interpolated distance at p; only says where to look.
DistanceBounds sampleBracket(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient);

/// A point and its distance: nowhere is the distance less than that minus the way there.
struct LowerCone {
  Vector3d apex;    ///< [m]
  double distance;  ///< [m]

  double operator()(const Vector3d& p_F) const { return distance - (p_F - apex).norm(); }
};

/// The one that gives sampleBracket() its lower bound; it says the most of points beside p_F too. None if there are no
/// samples.
std::optional<LowerCone> sampleCone(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient);

}  // namespace sdf_ccd
