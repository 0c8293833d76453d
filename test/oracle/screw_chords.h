#pragma once

#include <vector>

#include "motion/chords.h"

namespace sdf_ccd::test {

/// The chords of P's motion through poses X_FP, `length` [s] apart, with a constant twist in between while F rests.
/// @param ball  of P, in its frame.
inline ChordPath screwChords(const std::vector<Isometry3d>& X_FP, const BoundingBall& ball, const ChordOptions& options,
                             double length = 1.0) {
  const ScrewMotion rest(Isometry3d::Identity(), Isometry3d::Identity());
  ChordPath path;
  for (std::size_t k = 0; k + 1 < X_FP.size(); ++k) {
    const ScrewMotion screw(X_FP[k], X_FP[k + 1]);
    const double t0 = double(k) * length, t1 = double(k + 1) * length;
    addChords(TwoBodyMotion{t0, t1, rest, screw, screw.maxAcceleration(ball)}, options, static_cast<int>(k), path);
  }
  return path;
}

}  // namespace sdf_ccd::test
