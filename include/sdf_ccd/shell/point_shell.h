#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// Points on a body's surface, in its frame P.
struct PointShell {
  std::vector<Vector3d> points;   ///< [m]
  std::vector<Vector3d> normals;  ///< unit, pointing out
  std::vector<double> areas;      ///< surface area that each point stands for [m²]
  double covering_radius = 0.0;   ///< no place of the surface is farther than this from a point [m]; a true bound

  /// The same for the edges of its flat pieces, which deviate from planes by `flatness` [m]; see contact_gap.h.
  /// Infinite where edges have not been sampled apart.
  double edge_radius = std::numeric_limits<double>::infinity();
  double flatness = 0.0;

  std::size_t size() const { return points.size(); }
};

}  // namespace sdf_ccd
