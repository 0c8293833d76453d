#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "mesh/triangle.h"
#include "mesh/triangle_lanes.h"
#include "signed_surface.h"

namespace sdf_ccd {

/// The boundary of a mesh's solid, prepared for many queries in small regions of space.
class SurfaceIndex {
 public:
  explicit SurfaceIndex(const TriangleMesh& mesh) : SurfaceIndex(Solid(mesh)) {}
  explicit SurfaceIndex(Solid solid);

  /// A triangle's contribution to the sign of the distance.
  struct Face {
    Vector3d normal;  ///< of length one
    bool separates;   ///< see Solid::separates()
    bool sliver;
  };

  const SignedSurface& exact() const { return exact_; }
  /// The largest squared distance that ties with this one, as those of triangles with a common closest edge do.
  double tie2(double closest2) const {
    const double closest = std::sqrt(closest2) + exact_.solid().seam();
    return closest * closest * (1.0 + kTie);
  }
  const MeasuredTriangle& triangle(int i) const { return triangles_[static_cast<std::size_t>(i)]; }
  const Face& face(int i) const { return faces_[static_cast<std::size_t>(i)]; }

  /// As the functions of triangle_lanes.h, but for slivers too.
  void offer(int i, const Vector3d& axis, const PointLanes& points, ClosestLanes& closest) const;
  void displacements(int i, const PointLanes& points, DisplacementLanes& found) const;

 private:
  /// Relative rounding of squared distances, which is largest for slivers. A false tie costs little: if the triangles
  /// then disagree about the sign, the centre's sign decides.
  static constexpr double kTie = 1e-9;

  SignedSurface exact_;
  std::vector<MeasuredTriangle> triangles_;
  std::vector<Face> faces_;
  std::vector<FlatTriangle> flat_;
};

}  // namespace sdf_ccd
