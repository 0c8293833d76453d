#pragma once

#include <vector>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// An indexed triangle mesh; counter-clockwise triangles seen from outside.
struct TriangleMesh {
  std::vector<Vector3d> vertices;   ///< [m]
  std::vector<Vector3i> triangles;  ///< indices into `vertices`
};

/// Throws std::invalid_argument, naming the first bad element, if the mesh has no triangle, a vertex that is not
/// finite, an index out of range, an extent above 1e6 m or below 1e-9 m, or a point farther than 1e9 m from the origin.
void validate(const TriangleMesh& mesh);

/// Box around the vertices that triangles use; empty for an empty mesh.
AlignedBox3d boundingBox(const TriangleMesh& mesh);

/// Vector normal of a triangle: twice its area long, pointing outside [m²]. Zero for a degenerate triangle.
Vector3d areaNormal(const TriangleMesh& mesh, int triangle);

/// True if every edge is used as often in one direction as in the other: then the winding number is a whole number if
/// it is defined, and changes only across a triangle.
bool isClosed(const TriangleMesh& mesh);

/// Total area [m²].
double surfaceArea(const TriangleMesh& mesh);

/// Signed volume by the divergence theorem [m³], about the box's centre: the solid's volume if the mesh is closed.
double signedVolume(const TriangleMesh& mesh);

/// The mesh scaled along the axes. A mirroring scale (negative determinant) flips the triangles, so that
/// the outside stays outside.
/// @throws std::invalid_argument if a factor is zero or not finite.
TriangleMesh scaled(TriangleMesh mesh, const Vector3d& scale);

/// The mesh moved from its frame G to frame B.
TriangleMesh transformed(TriangleMesh mesh, const Isometry3d& X_BG);

/// Both meshes in one, without welding.
TriangleMesh merged(TriangleMesh first, const TriangleMesh& second);

/// Vertices at exactly the same position merged, unused vertices and triangles with two equal corners dropped.
TriangleMesh welded(const TriangleMesh& mesh);

}  // namespace sdf_ccd
