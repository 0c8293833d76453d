#pragma once

#include "sdf_ccd/shell/point_shell.h"

namespace sdf_ccd {

/// Upper bound of the distance from a point of either shell to the other surface if the surfaces touch or cross [m]; at
/// a distance D of the surfaces, D more.
///
/// A mesh's surface is the boundary of its solid (see Solid): faces within it have no points and need none, as nothing
/// touches them before the boundary. Seams, where the faces of overlapping parts meet, are borders of triangles without
/// a neighbour, and so are among the edges below.
///
/// Gaps between points of faces do not count, because faces alone never touch first. Let E be the edges of a
/// surface's flat pieces: away from E a surface is a plane nearby. Of the locations where surfaces A and B meet, take
/// an extreme point x of their convex hull. Were x neither on E_A nor on E_B, two planes would meet there, along a line
/// through x, and x not be extreme. So x lies on an edge of one of them, say A, and on B; a point of A's shell is
/// within A's edge radius of it. (Disjoint surfaces: of the nearest locations the extreme one, by the same argument.)
/// Where pieces deviate from planes by `flatness`, the planes do not meet but pass each other within the sum of both,
/// and point and field are off by as much again: twice the sum in all. One body wholly inside the other has a point
/// inside it.
///
/// Without a shell of B, A's points must cover all of A, unless B is a plane, which has no edges.
double contactGap(const PointShell& a, const PointShell& b);
double contactGapToPlane(const PointShell& a);

}  // namespace sdf_ccd
