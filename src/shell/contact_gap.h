#pragma once

#include "shell/point_shell.h"

namespace sdf_ccd {

/// If the surfaces of two shells touch or cross, a point of one of the shells is at most this far from the other
/// surface [m]. If the surfaces are a distance D apart, add D.
///
/// A mesh's surface is the boundary of its solid (see Solid): faces inside the solid have no points and need none, as
/// other bodies touch the boundary first. Seams, where the faces of overlapping parts meet, are borders of triangles
/// without a neighbour, and so are among the edges below.
///
/// The gaps between points on faces do not count, because a contact never begins between two faces alone. Let E be the
/// edges of a surface's flat pieces: near a point that is not on E, the surface is a plane. Take an extreme point x of
/// the convex hull of the intersection of surfaces A and B. If x were neither on E_A nor on E_B, two planes would
/// intersect there, along a line through x, and x would not be extreme. So x lies on an edge of one of them, say A, and
/// on B; a point of A's shell is within A's edge radius of x. (For disjoint surfaces the same argument holds for an
/// extreme one of the nearest points.) Where pieces deviate from planes by `flatness`, the planes may miss each other
/// by the sum of both flatnesses, and point and field deviate by as much again: twice the sum in total. If one body is
/// wholly inside the other, its points are inside.
///
/// Radii are about the points as shells hold them, so the gap includes their rounding. A rounded point may be outside
/// of its surface, though, by up to PointShell::position_error. Its depth proves a contact only if it is deeper than
/// that, and it may be as far outside of a body that its own body is inside of: PairForce adds it to the poses' error.
///
/// Without a shell of B, A's points must cover all of A, unless B is a plane, which has no edges.
double contactGap(const PointShell& a, const PointShell& b);
double contactGapToPlane(const PointShell& a);

}  // namespace sdf_ccd
