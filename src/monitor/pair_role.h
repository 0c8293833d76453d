#pragma once

#include <vector>

#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/motion/chords.h"
#include "swept_bodies.h"

namespace sdf_ccd {

/// What a shell's points stand for in a role.
enum class ShellPurpose {
  kSurface,    ///< where the surface touches, and how hard
  kEdges,      ///< where it touches; another role's impulse stands for the pair
  kWitnesses,  ///< whether a component of the surface lies wholly inside (design §3.15)
};

/// What following a role's motion needs while its pair is checked, and nobody afterwards.
struct RoleMemory {
  std::vector<double> accelerations;  ///< per interval of the span
  ChordPath path;
  ChordPath part_path;
  ShellQueryResult query;
};

/// One way to test a pair: the shell of one body (frame P) against the field of the other (frame F).
class PairRole {
 public:
  PairRole(const Scene& scene, int shell_body, int field_body, ShellPurpose purpose);

  const PointShell& shell() const { return *shell_; }
  const SphereTree& tree() const { return *tree_; }
  const Body& field() const { return *field_body_; }
  int fieldBody() const { return field_; }
  bool bearsForce() const { return purpose_ == ShellPurpose::kSurface; }

  /// Whether the shell's body's ball holds all of it: not of a half-space, which may have witnesses beside it. Only
  /// then travel(), jumpFrom() and ballClearance() tell of all of its surface, else of the witnesses alone.
  bool ballHoldsBody() const { return ball_holds_body_; }

  /// Takes the relative motion over a part of a cycle, of bodies that can be followed.
  /// @param memory  this role's alone as long as it has the motion.
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, RoleMemory& memory);

  /// No point of the shell's body goes farther than this in the field's frame, as setMotion() has it [m].
  double travel() const { return travel_; }

  /// What computing with the poses adds to the error of the distance [m].
  double poseError() const { return pose_error_; }

  /// How many times the motion error of the field's body's ball its surface strays where the shell is: more than one of
  /// a half-space, whose ball does not hold all of it. Bounds of motion grow no faster than the distance.
  double fieldErrorScale() const;

  /// At both ends of the motion.
  const Isometry3d& start() const { return X_FP_start_; }
  const Isometry3d& end() const { return X_FP_end_; }

  /// No point of the shell's body is farther from where it was at another pose than this, at the motion's start [m].
  double jumpFrom(const Isometry3d& X_FP) const { return maxDisplacement(X_FP, X_FP_start_, shell_body_->ball); }

  /// Cuts the motion into chords, for path() and partPath().
  void cut(const ChordOptions& options);
  const ChordPath& path() const { return memory_->path; }

  /// The same path seen from a part's frame G. The reference is good until the next call.
  const ChordPath& partPath(const BodyPart& part);

  /// Lower bound of the distance of the bodies' surfaces [m], from the shell's body's ball alone.
  double ballClearance(const Isometry3d& X_FP) const;

  /// Lower bound of the distance of the shell's points from the field's surfaces [m] at the end, within `slack` [m] of
  /// what the fields know.
  double pointClearanceAtEnd(double slack) const;

  /// False only if no point of the shell comes nearer than `distance` [m] to any part: conservative at any distance.
  bool mayComeNearer(double distance);

 private:
  /// No point of the shell's body is farther from the field's body's origin [m].
  double reach() const;

  const Body* shell_body_;
  const Body* field_body_;
  const PointShell* shell_;
  const SphereTree* tree_;
  int body_;
  int field_;
  ShellPurpose purpose_;
  bool ball_holds_body_;
  const SweptBodies* bodies_ = nullptr;
  WaypointSpan span_;
  RoleMemory* memory_ = nullptr;
  Isometry3d X_FP_start_, X_FP_end_;
  double travel_ = 0.0;
  double pose_error_ = 0.0;
};

}  // namespace sdf_ccd
