#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A part of a motion, by the indices of its first and last time.
struct WaypointSpan {
  std::size_t first = 0;
  std::size_t last = 0;

  bool empty() const { return first == last; }
};

/// Bodies farther than this from the world's origin are not checked [m]: there doubles round coordinates by 1e-8 m,
/// which the error bound does not include, and much farther they overflow.
constexpr double kFarthestPose = 1e8;

/// Where the bodies were during a cycle (t₀, t₁]. Between two times each body moves with a constant twist in the
/// world, along the shorter rotation: rotations of half a revolution and more between two times need times in between.
struct CycleMotion {
  std::vector<double> times;                  ///< [s] from t₀, increasing; first 0, last the cycle's length
  std::vector<std::vector<Isometry3d>> X_WB;  ///< per body, per time; or a single pose, of a body at rest
  std::vector<std::string> missing;  ///< per body: why its poses are not known, else empty; may be empty as a whole
  /// Per body: distance of the true motion of its ball from that of X_WB [m]; may be infinite, or empty (no error).
  std::vector<double> motion_error;

  /// Per pair of the scene: the part of the motion to check it over. An empty span delays the pair: its transforms are
  /// not known yet. No spans at all: every pair over all of the motion. Poses that no span needs are not read.
  std::vector<WaypointSpan> spans;

  /// Pose X_WB of a body at a time, by their indices.
  const Isometry3d& pose(std::size_t body, std::size_t time) const {
    return X_WB[body][std::min(time, X_WB[body].size() - 1)];
  }
};

}  // namespace sdf_ccd
