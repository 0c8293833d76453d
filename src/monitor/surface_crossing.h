#pragma once

#include <optional>
#include <vector>

#include "body/body_surface.h"
#include "query/shell_query.h"
#include "sdf_ccd/monitor/monitor.h"

/// A point inside a field with openings may have entered through an opening, without touching anything. There only a
/// crossing of the surfaces proves contact (design §3.14).
namespace sdf_ccd {

/// Whether a point certainly passes through the mesh on its path, in or out: it is first on one side and then on the
/// other by more than the errors, and stays farther than the path's error from all caps in between.
/// @param field       must have openings.
/// @param path        X_FP; consecutive chords share their end poses.
/// @param hit         of the point, from shellIntervals().
/// @param path_error  upper bound of the point's distance from its true position at the same time [m].
bool passesThroughMesh(const DistanceField& field, const ChordPath& path, const Vector3d& p_P, const ShellHit& hit,
                       double path_error);

/// A certain crossing of the pair's surfaces at one of up to 8 recorded times of its span, searched backwards from the
/// last: an edge of one pierces a triangle of the other, also if one is displaced by up to `pose_error` [m]; see
/// piercedPoint() for the proof. Empty if a body has no BodySurface, or neither has fields.
/// @param pair  gives the bodies and the span.
/// Cost: one test per pair of triangles that meet; a time ends without a crossing after 10⁵ tests.
std::optional<ContactPoint> crossingAtARecordedTime(const Scene& scene, const CycleMotion& motion,
                                                    const PairResult& pair, double pose_error);

/// Whether a point inside the body's fields may be outside the body: a field has openings, or the inside of a mesh is
/// doubtful.
bool isInsideUncertain(const Body& body);

}  // namespace sdf_ccd
