#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "chord_frame.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd {

/// Adds up the impulses of points at times of one chord after another, s from 0 to 1. Most points bear at the same few
/// times: what they bear then is added in the field's frame F, and turned into C once.
class ChordImpulses {
 public:
  /// @param sum_C  about C's origin: what has been turned is added to it. Complete after finish().
  explicit ChordImpulses(Wrench& sum_C) : sum_C_(sum_C) {}

  /// Sets the chord of the times that follow.
  void begin(const ChordFrame& frame) {
    finish();
    frame_ = frame;
  }

  /// The pose X_CF; valid until the next call.
  const Isometry3d& poseAt(double s) { return at(s).X_CF; }

  /// Adds an impulse at the point p_F [N·s].
  void add(double s, const Vector3d& p_F, const Vector3d& impulse_F) { add(s, p_F, Wrench{impulse_F}); }

  /// Adds an impulse and an angular impulse about the point p_F.
  void add(double s, const Vector3d& p_F, const Wrench& impulse_F) {
    Kept& kept = at(s);
    // About a point nearby, moments keep the precision that they lose about an origin far away.
    if (!kept.bears) kept.near_F = p_F;
    kept.bears = true;
    kept.sum_F += {impulse_F.force, impulse_F.torque + (p_F - kept.near_F).cross(impulse_F.force)};
  }

  /// Turns all that has been added.
  void finish() {
    for (std::size_t i = 0; i < known_; ++i) turn(kept_[i]);
    known_ = next_ = 0;
  }

 private:
  /// One time.
  struct Kept {
    double s;
    Isometry3d X_CF;
    bool bears = false;
    Vector3d near_F = Vector3d::Zero();
    Wrench sum_F = {};  // about near_F
  };

  Kept& at(double s) {
    for (std::size_t i = 0; i < known_; ++i)
      if (kept_[i].s == s) return kept_[i];
    Kept& kept = kept_[next_];
    if (next_ < known_) turn(kept);
    next_ = (next_ + 1) % kept_.size();
    known_ = std::max(known_, next_ == 0 ? kept_.size() : next_);
    kept = {s, frame_.pose(s)};
    return kept;
  }

  void turn(const Kept& kept) {
    if (!kept.bears) return;
    const Matrix3d& R_CF = kept.X_CF.linear();
    const Vector3d impulse = R_CF * kept.sum_F.force;
    sum_C_ += {impulse, R_CF * kept.sum_F.torque + (kept.X_CF * kept.near_F).cross(impulse)};
  }

  Wrench& sum_C_;
  ChordFrame frame_;
  std::array<Kept, 8> kept_;
  std::size_t known_ = 0, next_ = 0;
};

}  // namespace sdf_ccd
