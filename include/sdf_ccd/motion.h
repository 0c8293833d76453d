#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A part of a motion, by the indices of its first and last time.
struct WaypointSpan {
  std::size_t first = 0;
  std::size_t last = 0;

  /// Whether it has no length: see CycleMotion::spans.
  bool empty() const { return first == last; }
};

/// Bodies farther than this from the world's origin are not checked [m]: there doubles round coordinates by 1e-8 m,
/// which the error bound does not include, and much farther they overflow.
constexpr double kFarthestPose = 1e8;

/// From this angle on, two poses do not determine the direction of a frame's rotation [rad].
constexpr double kAmbiguousTurn = 3.14159265358979323846 - 1e-6;

/// Where the bodies were during a cycle (t₀, t₁]. Between two times each body moves with a constant twist in the
/// world, along the shorter rotation: rotations of half a revolution and more between two times need times in between.
struct CycleMotion {
  std::vector<double> times;                  ///< [s] from t₀, increasing; first 0, last the cycle's length
  std::vector<std::vector<Isometry3d>> X_WB;  ///< per body, per time; or a single pose, of a body at rest
  std::vector<std::string> missing;  ///< per body: why its poses are not known, else empty; may be empty as a whole
  /// Per body: distance of the true motion of its ball from that of X_WB [m]; may be infinite, or empty (no error).
  std::vector<double> motion_error;

  /// Per pair of the scene: the part of the motion to check it over. An empty span delays the pair: its transforms are
  /// not known yet; at the last waypoint, it is done. No spans at all: every pair over all of the motion. Poses that no
  /// span needs are not read.
  std::vector<WaypointSpan> spans;

  /// Pose X_WB of a body at a time, by their indices.
  const Isometry3d& pose(std::size_t body, std::size_t time) const {
    return X_WB[body][std::min(time, X_WB[body].size() - 1)];
  }

  /// The part of the motion to check a pair over.
  WaypointSpan span(std::size_t pair) const { return spans.empty() ? WaypointSpan{0, times.size() - 1} : spans[pair]; }
};

/// How closely samples follow a motion whose twists are not constant.
struct MotionSampling {
  double tolerance = 1e-4;  ///< deviation aimed at [m]
  int max_halvings = 5;     ///< of the time between two waypoints; what deviation is left then is reported
  /// Of all sampled bodies together; with this many, no more times are halved.
  std::size_t max_poses = std::numeric_limits<std::size_t>::max();
};

/// How closely chords follow the arcs of points that rotate.
struct ChordOptions {
  double tolerance = 1e-4;  ///< chord error aimed at [m]
  int max_chords = 1000;    ///< per recorded interval; a larger deviation then remains in ErrorSources::chord
};

}  // namespace sdf_ccd
