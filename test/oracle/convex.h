#pragma once

#include <array>
#include <functional>
#include <vector>

#include "oracle/long_screw.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

/// Exact separation of convex polytopes, flat polygons included, in long double.
namespace sdf_ccd::test {

/// A convex polytope by its corners; or a flat convex polygon, which is a polytope without thickness; or a ball.
struct Convex {
  std::vector<Vector3l> corners;
  std::vector<Vector3l> normals;  ///< unit; of its faces, one of each pair of opposite ones suffices
  std::vector<Vector3l> edges;    ///< unit directions, each once
  Vector3l center = Vector3l::Zero();
  bool is_ball = false;                            ///< all of the ball below; the corners are those of a box around it
  Real radius = 0;                                 ///< of a ball about the center that holds it
  std::vector<std::array<Vector3l, 3>> triangles;  ///< its surface
};

/// Of a mesh that is convex, its faces flat to rounding; all of its vertices count.
Convex convexOf(const TriangleMesh& mesh);

/// Flat and convex; corners in order.
Convex polygon(const std::vector<Vector3d>& corners);

Convex ball(double radius);

/// A solid, or a surface, made of convex pieces that may overlap.
using Pieces = std::vector<Convex>;

struct Separation {
  Real value = 0;  ///< positive: apart, and the distance is at least that [m]; else the depth of the overlap
  Vector3l axis_W = Vector3l::UnitX();  ///< unit, from A to B: moving B by d along it changes the value by about d
};

/// Largest gap along all axes that can separate (face normals, and cross products of edges): where it is negative,
/// moving B by that much, but not less, ends the overlap.
Separation separation(const Convex& a, const LongPose& X_WA, const Convex& b, const LongPose& X_WB);

/// Pieces, and how far they are apart along an axis at least [m].
using VisitPair = std::function<void(const Convex& a, const Convex& b, const Separation& at_least)>;

/// The least over all pairs of pieces. Pieces whose balls are farther apart than another pair's are not looked at.
/// @param visit  called for all pairs, if given; where the pieces' balls tell enough, with what these tell.
Separation separation(const Pieces& a, const LongPose& X_WA, const Pieces& b, const LongPose& X_WB,
                      const VisitPair& visit = {});

/// Distance of the surfaces [m]; exact, edge against edge and corner against face, unless they cross.
Real surfaceDistance(const Pieces& a, const LongPose& X_WA, const Pieces& b, const LongPose& X_WB);

/// Signed distance of a point in the body's frame from one convex solid [m]; negative inside.
Real signedDistance(const Convex& solid, const Vector3l& p);

}  // namespace sdf_ccd::test
