#pragma once

#include <cstddef>
#include <vector>

#include "sdf_ccd/geometry/eigen_types.h"

namespace sdf_ccd {

/// Points on a body's surface, in its frame P.
struct PointShell {
  std::vector<Vector3d> points;   ///< [m]
  std::vector<Vector3d> normals;  ///< unit, pointing out
  std::vector<double> areas;      ///< surface area that each point stands for [m²]
  double covering_radius = 0.0;   ///< no place of the surface is farther than this from a point [m]; a true bound

  std::size_t size() const { return points.size(); }
};

}  // namespace sdf_ccd
