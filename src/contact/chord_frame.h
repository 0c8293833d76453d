#pragma once

#include <optional>

#include "motion/chords.h"
#include "shell/point_shell.h"

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

/// A shell point along one chord, frame F (paper Eq. 1).
struct ChordPoint {
  const Chord* chord = nullptr;
  PackedNormal normal_P;  ///< out of the shell's body
  Vector3d start;         ///< [m]
  Vector3d step;          ///< [m], over the whole chord

  ChordPoint() = default;
  /// @param on  must outlive this.
  ChordPoint(const Chord& on, const Vector3d& p_P, const PackedNormal& n_P)
      : chord(&on), normal_P(n_P), start(on.X_FP_start * p_P), step(on.X_FP_end * p_P - start) {}

  double duration() const { return chord->t_end - chord->t_start; }  ///< [s]

  Vector3d position(double s) const { return start + s * step; }

  /// Minus the point's outward normal: out of the field's body where the two bodies touch.
  Vector3d inward(double s) const {
    const Vector3d n_P = normal_P.vector();
    return -((1.0 - s) * (chord->X_FP_start.linear() * n_P) + s * (chord->X_FP_end.linear() * n_P)).normalized();
  }

  /// Velocity of the shell's point relative to the field's body at the same point: v_A + ω_A×r_A − v_B −
  /// ω_B×r_B of Eq. 10, in F [m/s].
  Vector3d velocity() const { return step / duration(); }
};

}  // namespace sdf_ccd
