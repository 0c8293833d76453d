#pragma once

#include <vector>

#include "sdf_ccd/trajectory.h"
#include "two_body_motion.h"

namespace sdf_ccd {

/// A piece of a relative motion along which every point is assumed to move on a straight line (paper Eq. 1).
struct Chord {
  double t_start;  ///< [s]
  double t_end;    ///< [s]
  Isometry3d X_FP_start;
  Isometry3d X_FP_end;
  int interval;  ///< index of the interval between recorded poses that contains it
};

/// A relative motion as chords.
struct ChordPath {
  std::vector<Chord> chords;  ///< consecutive in time
  double error = 0.0;         ///< upper bound of the ball's points' deviation from their true positions [m]
};

/// Two bodies between two recorded times. Each moves with a constant twist in the world.
struct TwoBodyMotion {
  double t_start;  ///< [s]
  double t_end;    ///< [s]
  const ScrewMotion& X_WF;
  const ScrewMotion& X_WP;
  double acceleration;  ///< of P's points in F: RelativeMotionBounds

  /// P relative to F at s, from 0 to 1.
  Isometry3d X_FP(double s) const { return relativePose(X_WF.pose(s), X_WP.pose(s)); }
};

/// Calls query() with the part of a motion between two values of s, at one time if they are equal. Its s, from 0 to 1,
/// is that of the part; its times are those of the whole.
template <class Query>
auto withPart(const TwoBodyMotion& whole, double start, double end, const Query& query) {
  const ScrewMotion X_WF(whole.X_WF.pose(start), whole.X_WF.pose(end));
  const ScrewMotion X_WP(whole.X_WP.pose(start), whole.X_WP.pose(end));
  const double length = end - start;
  return query(TwoBodyMotion{whole.t_start, whole.t_end, X_WF, X_WP, length * length * whole.acceleration});
}

/// Appends the chords of one interval to the path, whose last chord must end where the interval begins, and updates its
/// error: n = ⌈√(a / 8 tol)⌉ where a bounds the points' acceleration (an arc of radius r through θ deviates by rθ²/8
/// from its chord). Chords end at the true relative poses X_WF(s)⁻¹ X_WP(s): design §3.12.
/// @param interval  Chord::interval of the chords added.
void addChords(const TwoBodyMotion& motion, const ChordOptions& options, int interval, ChordPath& path);

/// Two bodies between two recorded times. Their frames' origins move straight at constant speeds, and each body rotates
/// about its origin at a constant rate, by less than half a revolution, as a body under no force does.
struct DriftingBodies {
  double t_start;  ///< [s]
  double t_end;    ///< [s]
  const Isometry3d &X_WF_start, &X_WF_end;
  const Isometry3d &X_WP_start, &X_WP_end;
};

/// The same for such bodies. @param ball  of P, in its frame.
void addChords(const DriftingBodies& motion, const BoundingBall& ball, const ChordOptions& options, int interval,
               ChordPath& path);

}  // namespace sdf_ccd
