#pragma once

#include <optional>
#include <vector>

#include "body/body_surface.h"
#include "sdf_ccd/body/body.h"
#include "sdf_ccd/query/shell_query.h"

/// Where a field has openings, a place inside it may have come there by an opening, and then it touches nothing. What
/// proves a contact there is that surfaces cross (design §3.14).
namespace sdf_ccd {

/// Whether a point surely passes through the mesh on its path, in or out: it is outside and inside by more than the
/// errors, and no cap comes nearer than the path's error on its way from one to the other.
/// @param field       with openings.
/// @param path        X_FP; the chords' ends meet.
/// @param hit         of the point, as shellIntervals() has it.
/// @param path_error  the point is no farther than this from its true place at the same time [m].
bool passesThroughMesh(const DistanceField& field, const ChordPath& path, const Vector3d& p_P, const ShellHit& hit,
                       double path_error);

/// A place where the surfaces of two bodies cross.
struct SurfaceCrossing {
  Vector3d p_B;       ///< on B's surface [m]
  Vector3d normal_B;  ///< of its triangle there, unit
};

/// Whether the surfaces of A and B surely cross at a pose: an edge of one pierces a triangle of the other, and does so
/// wherever A is displaced by up to `pose_error`; see piercedPoint() for the proof.
/// @param a, b  with BodySurface; B has fields, by which only triangles of A that come near are looked at.
/// @param pose_error  [m].
/// Cost: as many tests as triangles meet, at most 10⁵; then the answer is none.
std::optional<SurfaceCrossing> surfacesCross(const Body& a, const Body& b, const Isometry3d& X_BA, double pose_error);

/// Whether a place inside the body's fields may be none inside the body: some field has openings, or what is inside a
/// mesh is doubtful.
bool mayHoldNothing(const Body& body);

}  // namespace sdf_ccd
