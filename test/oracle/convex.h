#pragma once

#include <array>
#include <functional>
#include <vector>

#include "oracle/long_screw.h"
#include "sdf_ccd/mesh.h"

/// Exact separation of convex polytopes, flat polygons included, in long double.
namespace sdf_ccd::test {

/// A convex polytope by its corners; or a flat convex polygon, which is a polytope without thickness; or a ball.
struct Convex {
  std::vector<Vector3l> corners;
  std::vector<Vector3l> normals;  ///< unit, of its faces; one of two opposite normals suffices
  std::vector<Vector3l> edges;    ///< unit directions, each once
  Vector3l center = Vector3l::Zero();
  bool is_ball = false;                            ///< the bounding ball itself; corners: those of a box around it
  Real radius = 0;                                 ///< of the bounding ball about the center
  std::vector<std::array<Vector3l, 3>> triangles;  ///< its surface
};

/// From a convex mesh whose faces are flat to rounding; all of its vertices count.
Convex convexOf(const TriangleMesh& mesh);

/// A flat convex polygon; corners in order.
Convex polygon(const std::vector<Vector3d>& corners);

Convex ball(double radius);

/// A solid, or a surface, made of convex pieces that may overlap.
using Pieces = std::vector<Convex>;

struct Separation {
  Real value = 0;  ///< positive: a lower bound of the distance; negative: minus the depth of the overlap [m]
  Vector3l axis_W = Vector3l::UnitX();  ///< unit, from A to B: moving B by d along it changes the value by about d
};

/// The largest gap along all axes that can separate the two (face normals, and cross products of edges). If it is
/// negative, its magnitude is the shortest displacement of B that ends the overlap.
Separation separation(const Convex& a, const LongPose& X_WA, const Convex& b, const LongPose& X_WB);

/// Called with two pieces and a lower bound of their separation along an axis [m].
using VisitPair = std::function<void(const Convex& a, const Convex& b, const Separation& at_least)>;

/// The smallest separation of all pairs of pieces. Pairs whose balls are farther apart than that are not examined.
/// @param visit  if given, called for all pairs; for pairs that are not examined, with the separation of their balls.
Separation separation(const Pieces& a, const LongPose& X_WA, const Pieces& b, const LongPose& X_WB,
                      const VisitPair& visit = {});

/// Distance of the surfaces [m]; exact, edge against edge and corner against face, unless they cross.
Real surfaceDistance(const Pieces& a, const LongPose& X_WA, const Pieces& b, const LongPose& X_WB);

/// Signed distance of a point in the body's frame from one convex solid [m]; negative inside.
Real signedDistance(const Convex& solid, const Vector3l& p);

}  // namespace sdf_ccd::test
