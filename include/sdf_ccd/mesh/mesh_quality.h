#pragma once

#include <string>

#include "sdf_ccd/mesh/triangle_mesh.h"

namespace sdf_ccd {

/// Properties of a mesh, determined before a field is built from it.
struct MeshQuality {
  int triangles = 0;
  int degenerate_triangles = 0;  ///< without area
  int components = 0;            ///< connected over shared edges
  int boundary_edges = 0;        ///< used by one triangle
  int non_manifold_edges = 0;    ///< used by more than two
  int misoriented_edges = 0;     ///< used by two triangles that disagree about the outside
  int inverted_components = 0;   ///< closed components that were inside out (flipped by orientOutward())
  int inverted_sheets = 0;       ///< open parts whose back faced the outside (flipped, too)
  int negative_triangles = 0;    ///< of closed components that intersect themselves: still inside out, as they bound
                                 ///< lobes with a negative winding number
  int duplicate_triangles = 0;   ///< left out because another triangle has the same corners
  double duplicate_area = 0.0;   ///< of those [m²]
  int hidden_triangles = 0;      ///< left out: both sides of walls inside a solid
  double hidden_area = 0.0;      ///< of those, both sides [m²]
  int wall_triangles = 0;        ///< kept: both sides of walls without thickness that have the outside on both sides
  double volume = 0.0;           ///< signed, of the oriented mesh [m³]
  double area = 0.0;             ///< [m²]
  AlignedBox3d box;              ///< [m]
  bool doubtful = false;         ///< winding numbers may cancel each other inside solids, or fill cavities
  bool sign_trusted = false;     ///< closed after orientation, and not doubtful: inside and outside are certain
};

/// A mesh as orientOutward() returns it, and what was found on the way.
struct OrientedMesh {
  TriangleMesh mesh;
  MeshQuality quality;
};

/// Orients triangles so that neighbours agree and that a point is inside the solid if the winding number is not zero.
/// Vertices at the same position are welded.
///
/// A closed component that no other closed one contains is flipped to enclose positive volume; one inside others stays
/// unchanged: a cavity if it faces its inside, else a solid within a solid. If all components that no other one
/// contains are inside out, the whole file is, and everything is flipped. Open parts are flipped if their back is
/// visible from outside.
///
/// The mesh is doubtful if one of several parts had to be flipped, is drawn in both orientations, or intersects itself
/// so that it is inside out in places; if a cavity does not lie in exactly one other part, apart from it; or if a wall
/// without thickness remains.
///
/// Of triangles with the same corners one is kept. There are two exceptions. A face that two parts share, one part
/// within the other, is kept once per part. Of a wall drawn from both sides whose border lies on other triangles, both
/// sides are left out if they are certainly inside a solid, and kept otherwise: then they face opposite directions, add
/// nothing to any winding number, and distances to them are positive on both sides. The quality report counts all of
/// these.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
OrientedMesh orientOutward(const TriangleMesh& mesh);

/// One line of text: "300 triangles, closed, volume 1.2e-3 m^3, sign trusted".
std::string summary(const MeshQuality& quality);

/// A one-line warning for users who rely on inside and outside: that the sign is not trusted, or parts were flipped.
/// Empty if there is nothing to warn about.
std::string warningOf(const MeshQuality& quality);

}  // namespace sdf_ccd
