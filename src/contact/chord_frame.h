#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "motion/chords.h"

namespace sdf_ccd {

/// The field's frame F in the unaccelerated frame C along one chord: it moves with a constant twist. s in [0, 1].
class ChordFrame {
 public:
  ChordFrame() : X_CF_(Isometry3d::Identity()) {}
  ChordFrame(const Isometry3d& X_CF_start, const Isometry3d& X_CF_end) : X_CF_(X_CF_start) {
    if (X_CF_start.matrix() != X_CF_end.matrix()) motion_.emplace(X_CF_start, X_CF_end);
  }

  Isometry3d pose(double s) const { return motion_ ? motion_->pose(s) : X_CF_; }

 private:
  Isometry3d X_CF_;
  std::optional<ScrewMotion> motion_;  // none if F rests, which saves the trigonometry at every node
};

/// The poses of a ChordFrame; the last few are cached, as most points are evaluated at the same times.
class ChordPoses {
 public:
  void begin(const ChordFrame& frame) {
    frame_ = frame;
    known_ = next_ = 0;
  }

  /// @return a reference that is valid until the next call.
  const Isometry3d& at(double s) {
    for (std::size_t i = 0; i < known_; ++i)
      if (kept_[i].s == s) return kept_[i].X_CF;
    Kept& kept = kept_[next_];
    next_ = (next_ + 1) % kept_.size();
    known_ = std::max(known_, next_ == 0 ? kept_.size() : next_);
    kept = {s, frame_.pose(s)};
    return kept.X_CF;
  }

 private:
  struct Kept {
    double s;
    Isometry3d X_CF;
  };

  ChordFrame frame_;
  std::array<Kept, 8> kept_;
  std::size_t known_ = 0, next_ = 0;
};

/// A shell point along one chord, frame F (paper Eq. 1).
struct ChordPoint {
  Vector3d start;         ///< [m]
  Vector3d step;          ///< [m], over the whole chord
  Vector3d inward_start;  ///< minus the point's outward normal: out of the field's body where the two bodies touch
  Vector3d inward_end;
  double duration;  ///< [s]

  ChordPoint(const Chord& chord, const Vector3d& p_P, const Vector3d& normal_P)
      : start(chord.X_FP_start * p_P),
        step(chord.X_FP_end * p_P - start),
        inward_start(-(chord.X_FP_start.linear() * normal_P)),
        inward_end(-(chord.X_FP_end.linear() * normal_P)),
        duration(chord.t_end - chord.t_start) {}

  Vector3d position(double s) const { return start + s * step; }
  Vector3d inward(double s) const { return ((1.0 - s) * inward_start + s * inward_end).normalized(); }

  /// Velocity of the shell's point relative to the field's body at the same point: v_A + ω_A×r_A − v_B −
  /// ω_B×r_B of Eq. 10, in F [m/s].
  Vector3d velocity() const { return step / duration; }
};

}  // namespace sdf_ccd
