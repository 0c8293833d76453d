#pragma once

#include <vector>

#include "query/shell_query.h"
#include "relative_motion.h"

namespace sdf_ccd {

/// What the points of a role's shell are tested for.
enum class ShellPurpose {
  kSurface,    ///< contacts of the surface, with their forces
  kEdges,      ///< contacts of the edges; another role gives the pair's force
  kWitnesses,  ///< whether a component of the surface lies wholly inside the field's body (design §3.15)
};

/// Scratch memory for a role while its pair is checked.
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

  /// Whether the ball of the shell's body contains all of it; false for a body with a half-space, which may have
  /// witnesses of its other elements. If false, motion() and ballClearance() hold for the witnesses only.
  bool ballHoldsBody() const { return ball_holds_body_; }

  /// Sets the relative motion over a part of a cycle; SweptBodies::problem() must be empty for both bodies.
  /// @param memory  used by this role alone as long as it has the motion.
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, RoleMemory& memory);

  const RelativeMotion& motion() const { return motion_; }

  /// Cuts the motion into chords, for path() and partPath().
  void cut(const ChordOptions& options);
  const ChordPath& path() const { return memory_->path; }

  /// The path in a part's frame G. The reference is valid until the next call.
  const ChordPath& partPath(const BodyPart& part);

  /// Lower bound of the distance of the bodies' surfaces [m], from the ball of the shell's body alone.
  double ballClearance(const Isometry3d& X_FP) const;

  /// Lower bound of the distance of the shell's points from the field's surfaces at the end [m]. It is at most `slack`
  /// [m] below the best bound that the fields give.
  double pointClearanceAtEnd(double slack) const;

  /// Whether the shell's points are certainly outside the field's body at the end, given that its fields say so: that
  /// is not enough if the body's inside is doubtful.
  bool isOutsideAtEnd() const;

  /// False only if every point of the shell stays farther than `distance` [m] from all parts; holds for any distance.
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
