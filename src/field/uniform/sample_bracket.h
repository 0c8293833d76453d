#pragma once

#include <optional>

#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {

/// Bounds of the distance at a point from the exact samples around it [m].
///
/// The distance is 1-Lipschitz, so that φ(q) − |p−q| ≤ φ(p) ≤ φ(q) + |p−q| for every sample q. That is sharp where q
/// is on the shortest segment from p to the surface, or on its continuation: along it the distance changes by |p−q|. A
/// sample at a distance δ from that line and R from p has an error of about δ²/2R. Hence those nearest to the line are
/// used, one per layer of samples, as far as there are any: a few thousandths of a cell if the surface is smooth, and
/// the √3/2 that hold for any 1-Lipschitz function.
/// @param p_F       within the grid's box.
/// @param gradient  of the interpolated distance at p; only the direction of the search.
DistanceBounds sampleBracket(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient);

/// A point and its distance: nowhere is the distance less than that minus the distance from the point.
struct LowerCone {
  Vector3d apex;    ///< [m]
  double distance;  ///< [m]

  double operator()(const Vector3d& p_F) const { return distance - (p_F - apex).norm(); }
};

/// The one that gives sampleBracket() its lower bound; it is also the best near p_F. None if there are no
/// samples.
std::optional<LowerCone> sampleCone(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient);

}  // namespace sdf_ccd
