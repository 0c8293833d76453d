#pragma once

#include <vector>

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// The point of a shell that is nearest to a field's surface, within the field's accuracy.
struct ShellDistance {
  int point = -1;                          ///< of the shell
  double value = 0.0;                      ///< of the field there [m], negative inside
  double error = 0.0;                      ///< of `value`, and of how much nearer another point may be [m]
  Vector3d p_F = Vector3d::Zero();         ///< position of the point [m]
  Vector3d gradient_F = Vector3d::Zero();  ///< of the field there, pointing out
};

/// Finds it by descending into the spheres that may contain a nearer point.
/// Guarantee: the true distance of every point of the shell is at least value − error, and that of `point` at most
/// value + error.
/// @param max_distance  points that surely are farther away need not be found [m].
/// @param pending       scratch memory, reused.
/// @return point −1 if all points surely are farther away than max_distance.
ShellDistance shellDistance(const DistanceField& field, const PointShell& shell, const SphereTree& tree,
                            const Isometry3d& X_FP, double max_distance, std::vector<int>& pending);

}  // namespace sdf_ccd
