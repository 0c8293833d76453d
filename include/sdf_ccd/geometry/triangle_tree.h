#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Box hierarchy over the triangles of a mesh, for closest points and winding numbers.
///
/// Also holds, per node, the dipole expansion of Barill et al. 2018 (area-weighted centre, sum of area normals and
/// first-order moments). Copies the triangles in tree order, so the mesh need not outlive it.
class TriangleTree {
 public:
  /// @throws std::invalid_argument if the mesh is not valid (see validate()).
  explicit TriangleTree(const TriangleMesh& mesh);

  struct ClosestPoint {
    Vector3d point;   ///< on the mesh
    double distance;  ///< [m], unsigned
    int triangle;     ///< index in the mesh
  };

  /// Closest point of the mesh to p, if nearer than `max_distance`; triangle is -1 (distance `max_distance`) if not.
  ClosestPoint closestPoint(const Vector3d& p, double max_distance = kInfinity) const;

  /// Generalised winding number (Jacobson 2013): 1 inside and 0 outside a closed mesh. Hierarchical (Barill et al.
  /// 2018): far clusters are replaced by their expansion, with an error well below the 0.5 that decides the sign.
  /// @param accuracy  clusters nearer than accuracy × their radius are opened; infinity sums every triangle.
  double windingNumber(const Vector3d& p, double accuracy = 2.0) const;

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

 private:
  // Layout is chosen by the implementation.
};

}  // namespace sdf_ccd
