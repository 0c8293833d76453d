#pragma once

#include <limits>
#include <vector>

#include "shell/point_shell.h"

namespace sdf_ccd {

/// The points of a shell while they are chosen, in double precision. Members are as in PointShell.
struct SampledPoints {
  std::vector<Vector3d> points;
  std::vector<Vector3f> normals;  ///< unit, pointing out
  std::vector<float> areas;
  double covering_radius = 0.0;
  double edge_radius = std::numeric_limits<double>::infinity();
  double flatness = 0.0;

  std::size_t size() const { return points.size(); }
};

/// The shell of these points. Rounding displaces each point by at most the shell's position error, so a location within
/// a radius of the sampled point is within radius + error of the shell's: both radii are increased by it.
/// @param origin  PointShell::origin; without it, the middle of the points' box.
PointShell toShell(const SampledPoints& sampled, const Vector3d& origin);
PointShell toShell(const SampledPoints& sampled);

}  // namespace sdf_ccd
