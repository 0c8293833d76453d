#include "pair_verdict.h"

#include <utility>

#include "pose_rounding.h"
#include "scene/pair_bound.h"

namespace sdf_ccd {

PairVerdict::PairVerdict(const Body& a, const Body& b, double resolution) {
  if (haveSurfaces(a, b)) surfaces_.emplace(a, b, resolution);
}

void PairVerdict::setMotion(const PairMotion& pair, std::vector<RelativeMotionBounds>& bounds) {
  surfaces_->setMotion(pair, bounds);
  const RelativeMotion& motion = surfaces_->motion();
  const bool continues = X_FP_.matrix() == motion.start().matrix();
  if (!continues) {
    if (isKnown()) clearance_ -= motion.jumpFrom(X_FP_);
    outside_ = false;
    inside_.reset();
  }
  clearance_ -= motion.travel();
  X_FP_ = motion.end();
}

PairVerdict::Answer PairVerdict::decide(double motion_error, SeparationMemory& memory) {
  SurfacePair::Answer found = surfaces_->decide(motion_error, memory);
  if (found.state != SeparationState::kApart || found.far) inside_.reset();
  if (found.state == SeparationState::kApart) {
    if (found.far) {
      outside_ = true;
    } else if (!outside_ && !inside_) {
      findContainment();
    }
    if (outside_) {
      clearance_ = found.clearance;
      return {Verdict::kClear, {}, 0.0};
    }
    if (inside_) found.crossing = surfaces_->contactInside(*inside_);
  }
  forgetClearance();
  if (found.state == SeparationState::kOpen) found.crossing = surfaces_->findContact(motion_error, memory);
  return {found.crossing ? Verdict::kContact : Verdict::kUncertain, found.crossing, found.open_within};
}

/// Sets whether one body is inside the other, which takes many rays in a mesh whose inside is doubtful, and hardly
/// depends on small displacements. The surfaces must be apart.
void PairVerdict::findContainment() {
  constexpr double kSmall = 0.1;
  const RelativeMotion& motion = surfaces_->motion();
  if (undecided_ && motion.jumpFrom(undecided_->X_FP) < kSmall * surfaces_->size()) return;
  const int attempt = undecided_ ? undecided_->attempts : 0;
  const Containment found = surfaces_->containment(motion.end(), attempt);
  outside_ = found.excluded;
  inside_ = found.inside;
  undecided_.reset();
  if (!outside_ && !inside_) undecided_ = {motion.end(), attempt + 1};
}

void PairVerdict::forgetClearance() {
  clearance_ = kUnknown;
  outside_ = false;
}

void PairVerdict::postpone(double clearance) {
  clearance_ = clearance;
  outside_ = false;
  inside_.reset();
}

double PairVerdict::moveClearanceOut() {
  return std::exchange(clearance_, kUnknown);
}

void PairVerdict::remember(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB) {
  clearance_ = clearance;
  inside_.reset();
  X_FP_ = surfaces_->motion().fIsA() ? relativePose(X_WA, X_WB) : relativePose(X_WB, X_WA);
}

void PairVerdict::setFar(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB) {
  remember(clearance, X_WA, X_WB);
  outside_ = true;
}

void PairVerdict::forget() {
  forgetClearance();
  inside_.reset();
  undecided_.reset();
  if (surfaces_) surfaces_->forget();
}

}  // namespace sdf_ccd
