#include "pair_role.h"

#include "common/cancel_point.h"

namespace sdf_ccd {

PairRole::PairRole(const MonitoredBody& shell_body, const MonitoredBody& field_body, bool shell_is_a)
    : shell_body_(&shell_body), field_body_(&field_body), motion_(*field_body.body, *shell_body.body, !shell_is_a) {}

void PairRole::setMotion(const PairMotion& pair, RoleMemory& memory) {
  memory_ = &memory;
  motion_.set(pair, memory.bounds);
}

void PairRole::cut(const ChordOptions& options) {
  ChordPath& path = memory_->path;
  path.chords.clear();
  path.error = 0.0;
  for (std::size_t step = 0; step < motion_.steps(); ++step) {
    checkCancelled();  // an interval may have a thousand chords
    addChords(motion_.motion(step), options, static_cast<int>(step), path);
  }
}

const ChordPath& PairRole::partPath(const BodyPart& part) {
  const Isometry3d X_GB = part.X_BG.inverse();
  ChordPath& part_path = memory_->part_path;
  part_path = memory_->path;
  CancelTicks<> cancel;
  for (Chord& chord : part_path.chords) {
    cancel.check();
    chord.X_FP_start = X_GB * chord.X_FP_start;
    chord.X_FP_end = X_GB * chord.X_FP_end;
  }
  return part_path;
}

}  // namespace sdf_ccd
