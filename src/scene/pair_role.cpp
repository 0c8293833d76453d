#include "pair_role.h"

#include <algorithm>
#include <limits>

#include "may_approach.h"

namespace sdf_ccd {

PairRole::PairRole(const Scene& scene, int shell_body, int field_body, bool bears_force)
    : shell_(&scene.bodies[shell_body]),
      field_(&scene.bodies[field_body]),
      shell_body_(shell_body),
      field_body_(field_body),
      bears_force_(bears_force) {}

void PairRole::setMotion(const CycleMotion& motion, const KnotSpan& span) {
  const bool first = motion_.X_FP.empty();
  const Isometry3d last = first ? Isometry3d::Identity() : motion_.X_FP.back();
  motion_.times.assign(motion.times.begin() + span.first, motion.times.begin() + span.last + 1);
  motion_.X_FP.resize(motion_.times.size());
  for (std::size_t k = 0; k < motion_.times.size(); ++k) {
    const std::size_t knot = span.first + k;
    motion_.X_FP[k] = relativePose(motion.X_WB[field_body_][knot], motion.X_WB[shell_body_][knot]);
  }
  const auto between = [&](const Isometry3d& from, const Isometry3d& to) {
    if (!first && from.matrix() == to.matrix()) return 0.0;  // most pairs of a standing robot; seen before, so valid
    return ScrewMotion(from, to).maxTravel(shell_->ball);
  };
  jump_ = first ? 0.0 : between(last, motion_.X_FP.front());
  travel_ = 0.0;
  for (std::size_t k = 0; k + 1 < motion_.X_FP.size(); ++k) travel_ += between(motion_.X_FP[k], motion_.X_FP[k + 1]);
}

const ChordPath& PairRole::partPath(const BodyPart& part) {
  const Isometry3d X_GB = part.X_BG.inverse();
  part_path_ = path_;
  for (Chord& chord : part_path_.chords) {
    chord.X_FP_start = X_GB * chord.X_FP_start;
    chord.X_FP_end = X_GB * chord.X_FP_end;
  }
  return part_path_;
}

double PairRole::ballClearance(const Isometry3d& X_FP) const {
  double nearest = std::numeric_limits<double>::infinity();
  const Vector3d center_F = X_FP * shell_->ball.center;
  for (const BodyPart& part : field_->parts)
    nearest = std::min(nearest, part.field.lowerBound(part.X_BG.inverse() * center_F));
  return nearest - shell_->ball.radius - shell_->shell.covering_radius;
}

double PairRole::pointClearanceAtEnd(double slack) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const BodyPart& part : field_->parts) {
    const Isometry3d X_GP = part.X_BG.inverse() * motion_.X_FP.back();
    nearest = std::min(nearest, clearance(part.field, shell_->tree, shell_->shell, X_GP, slack));
  }
  return nearest;
}

bool PairRole::mayComeNearer(double distance) {
  for (const BodyPart& part : field_->parts) {
    const ChordPath& path = partPath(part);
    if (distance > part.field.band()) {
      if (mayApproach(part.field, shell_->shell, shell_->tree, path, distance)) return true;
      continue;
    }
    shellIntervals(part.field, shell_->shell, shell_->tree, path, {distance, true}, query_);
    if (query_.touches()) return true;
  }
  return false;
}

}  // namespace sdf_ccd
