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
  int inverted_components = 0;   ///< closed components that were inside out (turned round by orientOutward())
  double volume = 0.0;           ///< signed, of the oriented mesh [m³]
  double area = 0.0;             ///< [m²]
  AlignedBox3d box;              ///< [m]
  bool sign_trusted = false;     ///< closed after orientation: inside and outside are beyond doubt
};

struct OrientedMesh {
  TriangleMesh mesh;
  MeshQuality quality;
};

/// Turns triangles so that neighbours agree and every closed component encloses positive volume, except cavities:
/// components that lie inside another one and already point inwards. Vertices at the same place are welded.
/// Duplicate triangles are dropped, and so are walls that two solids share (a patch drawn from both sides).
///
/// Of parts that are not closed, only an outer skin that is clearly inside out is turned: it makes up at least four
/// sides of the mesh's box, and the volumes its triangles span with the box's centre are mostly negative, three to
/// one. The quality report describes what was found on the way.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
OrientedMesh orientOutward(const TriangleMesh& mesh);

/// One line for people: "300 triangles, closed, volume 1.2e-3 m^3, sign trusted".
std::string summary(const MeshQuality& quality);

}  // namespace sdf_ccd
