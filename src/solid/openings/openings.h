#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Triangles that close a mesh.
///
/// The edges that a mesh uses more often in one direction than in the other are its rims. They form closed loops,
/// whatever the mesh is, so triangles that fill these (caps) make the whole closed, with winding numbers that are
/// integers everywhere.
struct Openings {
  TriangleMesh caps;          ///< welded(merged(mesh, caps)) is closed; no triangles if the mesh is
  std::vector<double> reach;  ///< per triangle of `caps`: upper bound of its points' distance from the mesh [m]

  int count = 0;         ///< loops that are left after cracks have been bridged
  double area = 0.0;     ///< of the caps in these loops [m²]
  double longest = 0.0;  ///< length of the longest of these loops [m]
  double crack = 0.0;    ///< rims up to this distance from each other were joined [m]

  /// Share of the points of a grid at which the winding number of the mesh alone, where it is clear (below 0.1 or above
  /// 0.9), contradicts the closed mesh; relative to the points that are inside by either. If much of a mesh is missing,
  /// as of a polygon soup, the caps are a guess.
  double doubt = 0.0;
  int voxels = 0;  ///< cubes that were added to the caps (see findOpenings())
};

/// Caps for all openings of a mesh.
///
/// Rims that are near each other are joined first, with tolerances that grow from 1e-8 to 1e-4 of the mesh's diagonal,
/// so that cracks and T-junctions between panels get slivers, not caps over whole panels. Each of the loops that remain
/// gets a triangulation of small area (Barequet & Sharir 1995: the smallest; for a loop of more than 100 vertices,
/// after ears of small area were cut off). Two loops get a common one where that is smaller (the rims of a wall with
/// two sides).
///
/// If the result contradicts the winding number of the mesh at more than a twentieth of the points (see
/// Openings::doubt), wider tolerances are tried, up to a thirtieth of the diagonal, and the best is taken. Where the
/// winding number is still above 0.9 but the closed mesh has no inside, cubes are added: it is safer to call a location
/// doubtful than free.
/// @param mesh  oriented; meshes that are not closed are welded here.
/// @throws std::invalid_argument if the mesh is not valid (see validate()).
Openings findOpenings(const TriangleMesh& mesh);

/// One line of text: "3 openings, the longest 1.76 m around, 0.19 m^2 of caps".
std::string summary(const Openings& openings);

}  // namespace sdf_ccd
