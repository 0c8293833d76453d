#pragma once

#include "sdf_ccd/geometry/primitive.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// What a rigid body weighs and where.
struct MassProperties {
  double mass = 0.0;                    ///< [kg]
  Vector3d center = Vector3d::Zero();   ///< centre of mass [m], in the geometry's frame
  Matrix3d inertia = Matrix3d::Zero();  ///< about the centre of mass, in the geometry's axes [kg·m²]
};

/// Of the solid inside a closed mesh, by the divergence theorem: the signed sum over the tetrahedra that the triangles
/// span with the centre of the mesh's box (so that a mesh far from its frame's origin loses no digits).
///
/// @param density  [kg/m³], finite and positive.
/// @throws std::invalid_argument for a mesh that encloses no positive volume (open, flat, inside out), or a density
/// that is not valid. An open mesh with volume is taken as closed by the tetrahedra: see MeshQuality::boundary_edges.
MassProperties massProperties(const TriangleMesh& mesh, double density);

/// Of a primitive, in closed form.
/// @throws std::invalid_argument for a half-space, whose mass is infinite.
MassProperties massProperties(const Primitive& primitive, double density);

/// Throws std::invalid_argument, with the value, unless a rigid body can have this mass and inertia: finite, positive,
/// symmetric, and principal moments of which none exceeds the sum of the others.
void validateInertia(double mass, const Matrix3d& inertia);

}  // namespace sdf_ccd
