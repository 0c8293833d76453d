#pragma once

#include <vector>

#include "query/shell_query.h"
#include "relative_motion.h"

namespace sdf_ccd {

/// Scratch memory for a role while its pair is checked.
struct RoleMemory {
  std::vector<RelativeMotionBounds> bounds;
  ChordPath path;
  ChordPath part_path;
};

/// One way to find the contacts of a pair: the shell of one body (frame P) against the field of the other (frame F).
class PairRole {
 public:
  PairRole(const Scene& scene, int shell_body, int field_body);

  const PointShell& shell() const { return *shell_body_->shell; }
  const SphereTree& tree() const { return *shell_body_->tree; }
  const Body& field() const { return *field_body_; }
  int fieldBody() const { return motion_.f(); }

  /// Sets the relative motion over a part of a cycle; SweptBodies::problem() must be empty for both bodies.
  /// @param memory  used by this role alone as long as it has the motion.
  void setMotion(const SweptBodies& bodies, const WaypointSpan& span, RoleMemory& memory);

  const RelativeMotion& motion() const { return motion_; }

  /// Cuts the motion into chords, for path() and partPath().
  void cut(const ChordOptions& options);
  const ChordPath& path() const { return memory_->path; }

  /// The path in a part's frame G. The reference is valid until the next call.
  const ChordPath& partPath(const BodyPart& part);

 private:
  const Body* shell_body_;
  const Body* field_body_;
  RelativeMotion motion_;
  RoleMemory* memory_ = nullptr;
};

}  // namespace sdf_ccd
