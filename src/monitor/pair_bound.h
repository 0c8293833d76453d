#pragma once

#include "body/body_triangles.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// The largest error bound of a body's fields [m]; 0 if it has none.
double fieldError(const Body& body);

/// Error bound of a result of fields and shells before any motion: the field's error and the gap between points. Zero
/// if the pair's fields or shells were not built.
ErrorBound pairBound(const Scene& scene, const PlannedPair& pair);

/// Whether triangles decide the pair: those of both bodies, or those of one against a half-space.
bool trianglesDecide(const Body& a, const Body& b);
inline bool trianglesDecide(const Scene& scene, const PlannedPair& pair) {
  return trianglesDecide(scene.bodies[pair.body_a], scene.bodies[pair.body_b]);
}

/// Error bound of a pair's verdict before any motion: the deviation of the triangles if they decide, else pairBound().
ErrorBound verdictBound(const Scene& scene, const PlannedPair& pair);

/// Upper bound of the depth of points inside a body [m].
double greatestDepth(const Body& body);

/// Upper bound of the depth to which the surfaces of a pair cross if no point of its shells is inside [m], without the
/// errors of fields and motion. It exceeds the gap of pairBound(), which bounds only how far points are from where the
/// surfaces first touch: a rod goes through a plate that is thinner than the distance of the rod's points, and the
/// plate's surface is then as deep in the rod as the plate's points, or the rod's size, allow.
double hiddenDepth(const Scene& scene, const PlannedPair& pair);

}  // namespace sdf_ccd
