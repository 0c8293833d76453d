#pragma once

#include <string>

#include "field/signed_surface.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// Distances from a mesh by its triangles: what a field of it approximates.
class MeshDistance {
 public:
  /// Takes some ten microseconds per triangle. @param geometry  must hold a mesh.
  /// @throws std::invalid_argument if the mesh is not valid (see validate()).
  explicit MeshDistance(const GeometryDescription& geometry);

  /// About its inside; empty if there is nothing to warn about.
  const std::string& warning() const { return warning_; }

  /// Lower bound of the distance [m], by the box around the mesh; −infinity within it.
  double lowerBound(const Vector3d& p_G) const;

  /// Guarantee: |s − value| ≤ error for the distance s from the boundary of the mesh's solid; for either sign of s, if
  /// the sign of the mesh is not trusted (MeshQuality::sign_trusted) and the point has no free line of sight to the
  /// outside.
  FieldSample sample(const Vector3d& p_G) const;

 private:
  explicit MeshDistance(const OrientedMesh& oriented);

  SignedSurface surface_;
  bool is_sign_trusted_;
  std::string warning_;
  AlignedBox3d box_;
  double error_;  // of the boundary [m]
};

}  // namespace sdf_ccd
