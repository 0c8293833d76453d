#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// What is known of a mesh before a field is made of it.
struct MeshQuality {
  int triangles = 0;
  int degenerate_triangles = 0;  ///< without area
  int components = 0;            ///< connected over shared edges
  int boundary_edges = 0;        ///< used by one triangle
  int non_manifold_edges = 0;    ///< used by more than two
  int misoriented_edges = 0;     ///< neighbours that disagree about the outside
  int inverted_components = 0;   ///< closed components that were inside out (flipped by orientOutward())
  int inverted_sheets = 0;       ///< the same of parts that are not closed: their back saw the outside
  int negative_triangles = 0;    ///< of closed components that cross themselves: inside out still, as they bound lobes
                                 ///< whose winding number is below zero
  int duplicate_triangles = 0;   ///< left out, as another one has the same corners
  double duplicate_area = 0.0;   ///< of those [m²]
  int hidden_triangles = 0;      ///< left out: both sides of walls between solids, inside them
  double hidden_area = 0.0;      ///< of those, both sides [m²]
  int wall_triangles = 0;        ///< kept: both sides of walls without thickness, the outside on both
  double volume = 0.0;           ///< signed, of the oriented mesh [m³]
  double area = 0.0;             ///< [m²]
  AlignedBox3d box;              ///< [m]
  bool doubtful = false;         ///< winding numbers may cancel each other where solids are, or fill cavities
  bool sign_trusted = false;     ///< closed after orientation, and not doubtful: inside and outside are certain
};

struct OrientedMesh {
  TriangleMesh mesh;
  MeshQuality quality;
};

/// Orients triangles so that neighbours agree and that a point is inside the solid if the winding number is not zero.
/// Vertices at the same position are welded.
///
/// A closed component that no other closed one contains is flipped to enclose positive volume; one inside others
/// stays unchanged: a cavity if it faces its inside, else a solid within a solid. If all uncontained ones are inside
/// out, so is the file, and everything is flipped (resulting cavities are kept, but the sign is not trusted).
/// Parts that are not closed are flipped if their back is visible from outside.
///
/// If parts may cancel each other, walls without thickness close something off, or it is ambiguous whether one that is
/// inside another is a solid or a cavity, as one had to be flipped or is drawn in both orientations, the mesh is doubtful.
///
/// Triangles with the same corners are one, except faces that two parts share, one in the other, and walls drawn from
/// both sides whose border lies on other triangles: both sides are left out if they are certainly inside a solid, and
/// kept if not. Then they face each other, add nothing to any winding number, and distances to them are positive on
/// both sides. The quality report describes what was found meanwhile.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
OrientedMesh orientOutward(const TriangleMesh& mesh);

/// One line for people: "300 triangles, closed, volume 1.2e-3 m^3, sign trusted".
std::string summary(const MeshQuality& quality);

/// A warning for users who rely on the mesh's inside, in a line: that the sign is not trusted, that parts were
/// flipped. Empty if there is none.
std::string warningOf(const MeshQuality& quality);

}  // namespace sdf_ccd
