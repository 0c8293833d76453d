#include "pair_role.h"

#include <algorithm>
#include <limits>

#include "may_approach.h"
#include "pose_rounding.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
PairRole::PairRole(const Scene& scene, int shell_body, int field_body, ShellPurpose purpose)
    : shell_body_(&scene.bodies[shell_body]),
      field_body_(&scene.bodies[field_body]),
      shell_(purpose == ShellPurpose::kWitnesses ? &shell_body_->witnesses : &shell_body_->shell),
      tree_(purpose == ShellPurpose::kWitnesses ? &shell_body_->witness_tree : &shell_body_->tree),
      body_(shell_body),
      field_(field_body),
      purpose_(purpose),
      ball_holds_body_(ballHolds(*shell_body_)) {}

void PairRole::setMotion(const SweptBodies& bodies, const WaypointSpan& span, RoleMemory& memory) {
  memory_ = &memory;
  bodies_ = &bodies;
  span_ = span;
  X_FP_start_ = relativePose(bodies.screw(field_, span.first).start(), bodies.screw(body_, span.first).start());
  X_FP_end_ = relativePose(bodies.screw(field_, span.last - 1).end(), bodies.screw(body_, span.last - 1).end());
  memory_->accelerations.clear();
  travel_ = 0.0;
  for (std::size_t k = span.first; k < span.last; ++k) {
    const RelativeMotionBounds bounds = relativeMotionBounds(bodies.twist(field_, k), bodies.twist(body_, k));
    memory_->accelerations.push_back(bounds.acceleration);
    travel_ += bounds.travel;
  }
  const BoundingBall& ball = shell_body_->ball;
  pose_error_ = bodies.poseError(body_, ball.center.norm() + ball.radius) + bodies.poseError(field_, reach());
}

double PairRole::reach() const {
  const BoundingBall& ball = shell_body_->ball;
  return (X_FP_start_ * ball.center).norm() + ball.radius + travel_;
}

double PairRole::fieldErrorScale() const {
  if (ballHolds(*field_body_)) return 1.0;
  return std::max(1.0, reach() / kHalfSpaceRadius);
}

void PairRole::cut(const ChordOptions& options) {
  ChordPath& path = memory_->path;
  path.chords.clear();
  path.error = 0.0;
  const std::vector<double>& times = bodies_->times();
  for (std::size_t i = 0; i < memory_->accelerations.size(); ++i) {
    checkCancelled();  // an interval may have a thousand
    const std::size_t k = span_.first + i;
    const TwoBodyMotion motion{times[k], times[k + 1], bodies_->screw(field_, k), bodies_->screw(body_, k),
                               memory_->accelerations[i]};
    addChords(motion, options, static_cast<int>(i), path);
  }
}

const ChordPath& PairRole::partPath(const BodyPart& part) {
  const Isometry3d X_GB = part.X_BG.inverse();
  ChordPath& part_path = memory_->part_path;
  part_path = memory_->path;
  for (Chord& chord : part_path.chords) {
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
    const Isometry3d X_GP = part.X_BG.inverse() * X_FP_end_;
    nearest = std::min(nearest, clearance(part.field, *tree_, *shell_, X_GP, slack));
  }
  return nearest;
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
