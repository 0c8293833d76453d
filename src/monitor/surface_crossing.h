#pragma once

#include <optional>
#include <vector>

#include "body/body_surface.h"
#include "query/shell_query.h"
#include "sdf_ccd/body/body.h"

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

/// A point at which the surfaces of two bodies cross.
struct SurfaceCrossing {
  Vector3d p_B;       ///< on B's surface [m]
  Vector3d normal_B;  ///< of B's triangle there, unit
};

/// Whether the surfaces of A and B certainly cross at a pose: an edge of one pierces a triangle of the other, also if A
/// is displaced by up to `pose_error`; see piercedPoint() for the proof.
/// @param a, b  with BodySurface. B must have fields, which select the triangles of A that come near.
/// @param pose_error  [m].
/// Cost: one test per pair of triangles that meet; after 10⁵ tests the result is empty.
std::optional<SurfaceCrossing> surfacesCross(const Body& a, const Body& b, const Isometry3d& X_BA, double pose_error);

/// Whether a point inside the body's fields may be outside the body: a field has openings, or the inside of a mesh is
/// doubtful.
bool isInsideUncertain(const Body& body);

}  // namespace sdf_ccd
