#include "pair_role.h"

#include <algorithm>
#include <limits>

#include "geometry/trees/triangle_tree.h"
#include "may_approach.h"
#include "pose_rounding.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
PairRole::PairRole(const Scene& scene, int shell_body, int field_body, ShellPurpose purpose)
    : shell_body_(&scene.bodies[shell_body]),
      field_body_(&scene.bodies[field_body]),
      shell_(purpose == ShellPurpose::kWitnesses ? &*shell_body_->witnesses : &*shell_body_->shell),
      tree_(purpose == ShellPurpose::kWitnesses ? &*shell_body_->witness_tree : &*shell_body_->tree),
      purpose_(purpose),
      ball_holds_body_(ballContainsBody(*shell_body_)),
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

double PairRole::ballClearance(const Isometry3d& X_FP) const {
  double nearest = std::numeric_limits<double>::infinity();
  const Vector3d center_F = X_FP * shell_body_->ball.center;
  for (const BodyPart& part : field_body_->parts)
    nearest = std::min(nearest, part.field.lowerBound(part.X_BG.inverse() * center_F));
  return nearest - shell_body_->ball.radius;
}

double PairRole::pointClearanceAtEnd(double slack) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const BodyPart& part : field_body_->parts) {
    const Isometry3d X_GP = part.X_BG.inverse() * motion_.end();
    nearest = std::min(nearest, clearance(part.field, *tree_, *shell_, X_GP, slack));
  }
  return nearest;
}

bool PairRole::isOutsideAtEnd() const {
  const TriangleTree* surface = field_body_->doubtful.get();
  if (!surface) return true;
  const CancelPoint cancel;
  const BoundingBall& ball = field_body_->ball;
  for (std::size_t i = 0; i < shell_->size(); ++i) {
    cancel.check();
    const Vector3d p_F = motion_.end() * shell_->point(i);
    if ((p_F - ball.center).norm() <= ball.radius && !surface->seesOutside(p_F)) return false;
  }
  return true;
}

bool PairRole::mayComeNearer(double distance) {
  for (const BodyPart& part : field_body_->parts) {
    const ChordPath& path = partPath(part);
    if (distance > part.field.band()) {
      if (mayApproach(part.field, *shell_, *tree_, path, distance)) return true;
      continue;
    }
    shellIntervals(part.field, *shell_, *tree_, path, {distance, true}, memory_->query);
    if (memory_->query.touches()) return true;
  }
  return false;
}

}  // namespace sdf_ccd
