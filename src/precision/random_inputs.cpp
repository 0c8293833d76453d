#include "random_inputs.h"

#include <algorithm>
#include <cmath>

#include "common/pi.h"

namespace sdf_ccd::precision {

double uniform(Random& random, double low, double high) {
  return low + (high - low) * (double(random() >> 11) * 0x1.0p-53);
}

Vector3d uniformIn(Random& random, const AlignedBox3d& box) {
  Vector3d p;
  for (int k = 0; k < 3; ++k) p[k] = uniform(random, box.min()[k], box.max()[k]);
  return p;
}

Vector3d direction(Random& random) {
  const double z = uniform(random, -1.0, 1.0), angle = uniform(random, 0.0, 2.0 * kPi), r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Matrix3d rotation(Random& random) {
  const double u = uniform(random, 0.0, 1.0), a = uniform(random, 0.0, 2.0 * kPi), b = uniform(random, 0.0, 2.0 * kPi);
  const double v = std::sqrt(1.0 - u), w = std::sqrt(u);
  return Quaterniond(v * std::sin(a), v * std::cos(a), w * std::sin(b), w * std::cos(b)).toRotationMatrix();
}

SurfaceSampler::SurfaceSampler(const TriangleMesh& mesh) : mesh_(mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) areas_.push_back(sum += areaNormal(mesh, int(i)).norm());
}

int SurfaceSampler::triangle(Random& random) const {
  const auto at = std::upper_bound(areas_.begin(), areas_.end() - 1, uniform(random, 0.0, areas_.back()));
  return int(at - areas_.begin());
}

Vector3d SurfaceSampler::pointOn(Random& random, int triangle) const {
  const Vector3i& t = mesh_.triangles[triangle];
  const double r = std::sqrt(uniform(random, 0.0, 1.0)), s = uniform(random, 0.0, 1.0);
  return (1.0 - r) * mesh_.vertices[t[0]] + r * ((1.0 - s) * mesh_.vertices[t[1]] + s * mesh_.vertices[t[2]]);
}

}  // namespace sdf_ccd::precision
