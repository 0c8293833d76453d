#pragma once

#include "sdf_ccd/geometry/eigen_types.h"
#include "sdf_ccd/motion/chords.h"

namespace sdf_ccd {

/// The field's frame F in the unaccelerated frame C along one chord: it turns at a constant rate (slerp) while its
/// origin runs straight. s in [0, 1].
class ChordFrame {
 public:
  ChordFrame() = default;
  ChordFrame(const Isometry3d& X_CF_start, const Isometry3d& X_CF_end)
      : R_start_(X_CF_start.linear()),
        origin_(X_CF_start.translation()),
        step_(X_CF_end.translation() - X_CF_start.translation()),
        turn_(Matrix3d(X_CF_start.linear().transpose() * X_CF_end.linear())) {}

  Matrix3d rotation(double s) const {
    if (turn_.angle() == 0.0) return R_start_;  // a body of the world: no sine for every node
    return R_start_ * Eigen::AngleAxisd(s * turn_.angle(), turn_.axis()).toRotationMatrix();
  }
  Vector3d origin(double s) const { return origin_ + s * step_; }

 private:
  Matrix3d R_start_ = Matrix3d::Identity();
  Vector3d origin_ = Vector3d::Zero();
  Vector3d step_ = Vector3d::Zero();
  Eigen::AngleAxisd turn_ = Eigen::AngleAxisd::Identity();  // F's axes at the start to those at the end
};

/// A shell point along one chord, frame F (paper Eq. 1).
struct ChordPoint {
  Vector3d start;         ///< [m]
  Vector3d step;          ///< [m], over the whole chord
  Vector3d inward_start;  ///< minus the point's outward normal: out of the field's body where the two press
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

  /// Of the shell's point relative to the field's body at the same place: v_A + ω_A×r_A − v_B − ω_B×r_B of Eq. 10,
  /// seen from F [m/s].
  Vector3d velocity() const { return step / duration; }
};

}  // namespace sdf_ccd
