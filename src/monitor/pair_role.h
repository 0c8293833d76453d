#pragma once

#include <vector>

#include "monitored_body.h"
#include "query/shell_query.h"
#include "relative_motion.h"
#include "shell/point_shell.h"

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
  /// The bodies must outlive this. @param shell_is_a  the body with the shell is body A of the pair.
  PairRole(const MonitoredBody& shell_body, const MonitoredBody& field_body, bool shell_is_a);

  bool shellIsA() const { return !motion_.fIsA(); }
  const PointShell& shell() const { return *shell_body_->body->shell; }
  GroupedShell groupedShell() const { return {shell(), *shell_body_->body->tree, shell_body_->sums}; }
  const Body& field() const { return *field_body_->body; }
  const std::vector<SiblingField>& siblings(std::size_t part) const { return field_body_->siblings[part]; }

  /// Sets the relative motion over a part of a cycle.
  /// @param memory  used by this role alone as long as it has the motion.
  void setMotion(const PairMotion& pair, RoleMemory& memory);

  const RelativeMotion& motion() const { return motion_; }

  /// Cuts the motion into chords, for path() and partPath().
  void cut(const ChordOptions& options);
  const ChordPath& path() const { return memory_->path; }

  /// The path in a part's frame G. The reference is valid until the next call.
  const ChordPath& partPath(const BodyPart& part);

 private:
  const MonitoredBody *shell_body_, *field_body_;
  RelativeMotion motion_;
  RoleMemory* memory_ = nullptr;
};

}  // namespace sdf_ccd
