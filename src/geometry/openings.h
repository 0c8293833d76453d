#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// What closes a mesh.
///
/// The edges that a mesh runs along more often one way than the other are its rims: always closed loops, whatever the
/// mesh, so triangles within them (caps) make the whole closed, with winding numbers that are whole everywhere.
struct Openings {
  TriangleMesh caps;          ///< welded(merged(mesh, caps)) is closed; no triangles if the mesh is
  std::vector<double> reach;  ///< per triangle of `caps`: no place of it is farther from the mesh [m]

  int count = 0;         ///< loops that are left when cracks have been bridged
  double area = 0.0;     ///< of the caps in these loops [m²]
  double longest = 0.0;  ///< the longest of these loops [m]
  double crack = 0.0;    ///< up to this distance rims were joined to each other [m]

  /// Of the places on a grid where either the winding number of the mesh alone is clear (below 0.1 or above 0.9) and
  /// inside, or the closed mesh has its inside, the share where the two differ: where much is missing, as of a polygon
  /// soup, the caps are a guess.
  double doubt = 0.0;
  int voxels = 0;  ///< cubes that were added to the caps (see findOpenings())
};

/// Caps for all openings of a mesh.
///
/// Rims that are near each other are joined first, with tolerances that grow from 1e-8 to 1e-4 of the mesh's diagonal,
/// so that cracks and T-junctions between panels get slivers, not caps over whole panels. What remains are loops. Each
/// gets a triangulation of small area (Barequet & Sharir 1995: the smallest, of a loop with more than 100 vertices
/// after ears of small area were cut off), two of them a common one where that is smaller (the rims of a wall with two
/// sides).
///
/// Where the result contradicts the winding number of the mesh at more than a twentieth of the places (see
/// Openings::doubt), wider tolerances are tried, up to a thirtieth of the diagonal, and the best is taken. Where the
/// winding number still is above 0.9 and the closed mesh has no inside, cubes are added: it is better to call a place
/// doubtful than free.
/// @param mesh  oriented; not closed meshes are welded here.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
Openings findOpenings(const TriangleMesh& mesh);

/// One line for people: "3 openings, the longest of 1.76 m, 0.19 m^2 of caps".
std::string summary(const Openings& openings);

}  // namespace sdf_ccd
