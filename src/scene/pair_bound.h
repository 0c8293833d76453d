#pragma once

#include "scene/body_triangles.h"
#include "sdf_ccd/result.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// The largest error bound of a body's fields [m]; 0 if it has none.
double fieldError(const Body& body);

/// Error bound of the contacts that shells find in fields, before any motion: the field's error and the gap between
/// points. Zero if the pair has no fields and shells.
/// @param pair  of these bodies: tells whose shells are used.
ErrorSources contactBound(const Body& a, const Body& b, const PlannedPair& pair);

/// Whether there are surfaces that decide a pair: the triangles of both bodies, one of which may have a half-space
/// instead or as well.
bool haveSurfaces(const Body& a, const Body& b);
inline bool haveSurfaces(const Scene& scene, const PlannedPair& pair) {
  return haveSurfaces(scene.bodies[pair.body_a], scene.bodies[pair.body_b]);
}

/// Upper bound of the distance between the triangles and the true surfaces, both bodies together [m].
double deviationOf(const Body& a, const Body& b);

/// Upper bound of the depth of points inside a body [m].
double greatestDepth(const Body& body);

/// Upper bound of the depth to which the surfaces of a pair cross if no point of its shells is inside [m], without the
/// errors of fields and motion. It exceeds the gap of contactBound(), which bounds only how far points are from where
/// the surfaces first touch: a rod goes through a plate that is thinner than the distance of the rod's points, and the
/// plate's surface is then as deep in the rod as the plate's points, or the rod's size, allow.
double hiddenDepth(const Body& a, const Body& b, const PlannedPair& pair);

}  // namespace sdf_ccd
