#pragma once

#include <vector>

#include "relative_motion.h"

namespace sdf_ccd {

/// What a shell's points stand for in a role.
enum class ShellPurpose {
  kSurface,    ///< where the surface touches, and how hard
  kEdges,      ///< where it touches; another role's impulse stands for the pair
  kWitnesses,  ///< whether a component of the surface lies wholly inside (design §3.15)
};

/// What following a role's motion needs while its pair is checked, and nobody afterwards.
struct RoleMemory {
  std::vector<RelativeMotionBounds> bounds;
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
  int fieldBody() const { return motion_.f(); }
  bool bearsForce() const { return purpose_ == ShellPurpose::kSurface; }

  /// Whether the shell's body's ball holds all of it: not of a half-space, which may have witnesses beside it. Only
  /// then motion() and ballClearance() tell of all of its surface, else of the witnesses alone.
  bool ballHoldsBody() const { return ball_holds_body_; }

  /// Takes the relative motion over a part of a cycle, of bodies that can be followed.
  /// @param memory  this role's alone as long as it has the motion.
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, RoleMemory& memory);

  const RelativeMotion& motion() const { return motion_; }

  /// How many times the motion error of the field's body's ball its surface strays where the shell is: more than one of
  /// a half-space, whose ball does not hold all of it. Bounds of motion grow no faster than the distance.
  double fieldErrorScale() const;

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

  /// Whether the shell's points are surely outside the field's body at the end, given that they are by its fields:
  /// these are not enough where it is doubtful what is inside the body.
  bool isOutsideAtEnd() const;

  /// False only if no point of the shell comes nearer than `distance` [m] to any part: conservative at any distance.
  bool mayComeNearer(double distance);

 private:
  const Body* shell_body_;
  const Body* field_body_;
  const PointShell* shell_;
  const SphereTree* tree_;
  ShellPurpose purpose_;
  bool ball_holds_body_;
  RelativeMotion motion_;
  RoleMemory* memory_ = nullptr;
};

}  // namespace sdf_ccd
