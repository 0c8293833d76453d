#pragma once

#include <vector>

#include "mesh/triangle_tree.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// The parts of a field's surface that are not on its mesh: triangles that close the openings (see findOpenings()).
class OpeningCaps {
 public:
  /// @param reach  per triangle: upper bound of its points' distance from the mesh [m].
  /// @throws std::invalid_argument if the mesh is not valid, or the reaches do not fit it.
  OpeningCaps(TriangleMesh mesh, std::vector<double> reach);

  const TriangleMesh& mesh() const { return mesh_; }
  const std::vector<double>& reach() const { return reach_; }

  /// Distance of the nearest cap [m].
  double distance(const Vector3d& p_F) const { return tree_.closestPoint(p_F).distance; }

  /// Whether a cap is at most this far; cheaper than distance() if none is.
  bool isWithin(const Vector3d& p_F, double distance) const { return tree_.closestPoint(p_F, distance).triangle >= 0; }

  /// Upper bound of the distance from the mesh alone [m]: the path through the nearest cap.
  double meshDistanceBound(const Vector3d& p_F) const;

  std::size_t bytes() const;

 private:
  TriangleMesh mesh_;
  std::vector<double> reach_;
  TriangleTree tree_;
};

/// Of a sample of the surface that caps close, one of the mesh alone: see DistanceField::meshSample().
FieldSample overMesh(FieldSample of_closed, const OpeningCaps& caps, const Vector3d& p_F);

}  // namespace sdf_ccd
