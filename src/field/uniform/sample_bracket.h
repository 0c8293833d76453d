#pragma once

#include <optional>

#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// Bounds of the distance at a point from the exact samples around it [m].
///
/// The distance is 1-Lipschitz, so that φ(q) − |p−q| ≤ φ(p) ≤ φ(q) + |p−q| for every sample q. That is
/// sharp where q is on the shortest segment from p to the surface, or on its continuation: along it the distance
/// changes by |p−q|. A sample at a distance δ from that line and R from p has an error of about δ²/2R. Hence the
/// samples nearest to the line are used, one per layer of samples, as long as there are any. The bounds are a few
/// thousandths of a cell from the distance if the surface is smooth, and √3/2 of a cell in general.
/// @param p_F       within the grid's box.
/// @param gradient  of the interpolated distance at p; only gives the direction of the search.
DistanceBounds sampleBracket(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient);

/// A lower bound of φ from its value at one point: φ(p) ≥ distance − |p − apex| everywhere.
struct LowerCone {
  Vector3d apex;    ///< [m]
  double distance;  ///< [m]

  double operator()(const Vector3d& p_F) const { return distance - (p_F - apex).norm(); }
};

/// The cone that gives the lower bound of sampleBracket(); also the best one near p_F. None if there are no samples.
std::optional<LowerCone> sampleCone(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient);

}  // namespace sdf_ccd
