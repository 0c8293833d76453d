#pragma once

#include <memory>
#include <string>

#include "field/opening_caps.h"
#include "field/signed_surface.h"
#include "sdf_ccd/body.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "solid/closed_solid.h"

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

  /// Contains the solid that sample() measures.
  AlignedBox3d box() const {
    const Vector3d error = Vector3d::Constant(error_);
    return {box_.min() - error, box_.max() + error};
  }

  /// Guarantee: |s − value| ≤ error for the distance s from the mesh, as DistanceField::meshSample() says: the value is
  /// that of the solid that caps close, and the error large where it counts as inside that, or where a cap may be the
  /// nearest surface. If the sign of the mesh is not trusted (MeshQuality::sign_trusted) it holds for either sign of s,
  /// unless the point has a free line of sight to the outside.
  FieldSample sample(const Vector3d& p_G) const;

 private:
  explicit MeshDistance(const OrientedMesh& oriented);
  MeshDistance(const OrientedMesh& oriented, const ClosedSolid& closed);

  SignedSurface surface_;                    // closed by the caps
  std::shared_ptr<const OpeningCaps> caps_;  // null if there are none
  bool is_sign_trusted_;
  std::string warning_;
  AlignedBox3d box_;
  double error_;  // of the boundary [m]
  double doubt_;  // depths may be too small by this, because of faces inside the solid [m]
};

}  // namespace sdf_ccd
