#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/random.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd::benchmark {

/// Points spread over a mesh's surface, uniform by area, independent of each other.
inline std::vector<Vector3d> surfacePoints(const TriangleMesh& mesh, std::size_t count, test::Random& random) {
  std::vector<double> areas;  // running sum
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) areas.push_back(sum += areaNormal(mesh, int(i)).norm());
  std::vector<Vector3d> points(count);
  for (Vector3d& p : points) {
    const auto at = std::upper_bound(areas.begin(), areas.end() - 1, test::uniform(random, 0.0, sum));
    const Vector3i& t = mesh.triangles[std::size_t(at - areas.begin())];
    const double r = std::sqrt(test::uniform(random, 0.0, 1.0)), s = test::uniform(random, 0.0, 1.0);
    p = (1.0 - r) * mesh.vertices[t[0]] + r * ((1.0 - s) * mesh.vertices[t[1]] + s * mesh.vertices[t[2]]);
  }
  return points;
}

}  // namespace sdf_ccd::benchmark
