#pragma once

#include <random>
#include <vector>

#include "sdf_ccd/mesh.h"

/// Repeatable random inputs for studies.
namespace sdf_ccd::precision {

using Random = std::mt19937_64;

/// Uniform in [low, high).
double uniform(Random& random, double low, double high);
Vector3d uniformIn(Random& random, const AlignedBox3d& box);

/// A unit vector, uniform over the sphere.
Vector3d direction(Random& random);

/// A rotation, uniform over all orientations (Shoemake 1992).
Matrix3d rotation(Random& random);

/// Draws independent points on a mesh's surface, uniform by area.
class SurfaceSampler {
 public:
  /// @param mesh  must outlive this.
  explicit SurfaceSampler(const TriangleMesh& mesh);

  Vector3d operator()(Random& random) const { return pointOn(random, triangle(random)); }

  /// Index of a triangle, with a probability proportional to its area.
  int triangle(Random& random) const;
  /// A point in the triangle, uniform by area.
  Vector3d pointOn(Random& random, int triangle) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<double> areas_;  // running sum
};

}  // namespace sdf_ccd::precision
