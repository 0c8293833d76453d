#pragma once

#include <vector>

#include "sdf_ccd/motion/chords.h"
#include "sdf_ccd/scene/monitor.h"

namespace sdf_ccd {

/// X_FP from two poses in the world; the origins are subtracted first, so that nothing is lost far from the world's.
inline Isometry3d relativePose(const Isometry3d& X_WF, const Isometry3d& X_WP) {
  Isometry3d X_FP = Isometry3d::Identity();
  X_FP.linear() = X_WF.linear().transpose() * X_WP.linear();
  X_FP.translation() = X_WF.linear().transpose() * (X_WP.translation() - X_WF.translation());
  return X_FP;
}

/// One way to test a pair: the shell of one body (frame P) against the field of the other (frame F).
class PairRole {
 public:
  /// @param bears_force  false: it shows where the shell touches, another role's impulse stands for the pair.
  PairRole(const Scene& scene, int shell_body, int field_body, bool bears_force);

  const Body& shell() const { return *shell_; }
  const Body& field() const { return *field_; }
  int fieldBody() const { return field_body_; }
  bool bearsForce() const { return bears_force_; }

  /// Takes the relative motion over a part of a cycle. Distances may have shrunk by travel() within it and by jump()
  /// between the last one's end and its start.
  void setMotion(const CycleMotion& motion, const KnotSpan& span);
  /// Takes the next motion's start as unrelated to this one's end.
  void forget() { motion_.X_FP.clear(); }
  double travel() const { return travel_; }
  double jump() const { return jump_; }

  /// Cuts the motion into chords, for path() and partPath().
  void cut(const ChordOptions& options) { cutIntoChords(motion_, shell_->ball, options, path_); }
  const ChordPath& path() const { return path_; }

  /// The same path seen from a part's frame G. The reference is good until the next call.
  const ChordPath& partPath(const BodyPart& part);

  /// Lower bound of the distance of the bodies' surfaces [m], from the shell's ball and covering radius alone, at both
  /// ends.
  double ballClearanceAtStart() const { return ballClearance(motion_.X_FP.front()); }
  double ballClearanceAtEnd() const { return ballClearance(motion_.X_FP.back()); }

  /// Lower bound of the distance of the shell's points from the field's surfaces [m] at the end, within `slack` [m] of
  /// what the fields know.
  double pointClearanceAtEnd(double slack) const;

  /// False only if no point of the shell comes nearer than `distance` [m] to any part: conservative at any distance.
  bool mayComeNearer(double distance);

 private:
  double ballClearance(const Isometry3d& X_FP) const;

  const Body* shell_;
  const Body* field_;
  int shell_body_;
  int field_body_;
  bool bears_force_;
  RelativePath motion_;
  double travel_ = 0.0;
  double jump_ = 0.0;
  ChordPath path_;
  ChordPath part_path_;
  ShellQueryResult query_;
};

}  // namespace sdf_ccd
