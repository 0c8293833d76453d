#include "pair_role.h"

#include "sdf_ccd/cancel.h"

namespace sdf_ccd {

PairRole::PairRole(const Scene& scene, int shell_body, int field_body)
    : shell_body_(&scene.bodies[shell_body]),
      field_body_(&scene.bodies[field_body]),
      motion_(scene, field_body, shell_body) {}

void PairRole::setMotion(const SweptBodies& bodies, const WaypointSpan& span, RoleMemory& memory) {
  memory_ = &memory;
  motion_.take(bodies, span, memory.bounds);
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
