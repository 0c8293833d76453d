#include "shell/point_shell.h"

#include <algorithm>

namespace sdf_ccd {

std::vector<Vector3d> PointShell::points() const {
  std::vector<Vector3d> points;
  points.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) points.push_back(point(i));
  return points;
}

void PointShell::add(const Vector3d& p, const Vector3d& normal, float area) {
  constexpr double kLargest = 1e38;  // beyond single precision; the error then is the distance from it
  const Vector3d offset = p - origin;
  offsets.push_back(offset.cwiseMax(-kLargest).cwiseMin(kLargest).cast<float>());
  normals.emplace_back(normal);
  areas.push_back(area);
  position_error = std::max(position_error, (point(size() - 1) - p).norm());
}

}  // namespace sdf_ccd
