#include "sphere_sides.h"

#include <optional>

#include "shell_points.h"

namespace sdf_ccd {
namespace {

SphereGroup& threadGroup() {
  thread_local SphereGroup group;
  group.size = 0;
  return group;
}

}  // namespace

#ifdef SDF_CCD_HIGHWAY

struct SphereSides::Vectors {
  std::optional<AdaptiveLanes> adaptive;
  std::optional<UniformLanes> uniform;
  std::optional<SphereSweep> sweep;
  SphereWork work;

  /// This thread's vectors for a field; null if the field has no vector code.
  static Vectors* of(const DistanceField& field) {
    thread_local Vectors vectors;
    vectors.adaptive.reset();
    vectors.uniform.reset();
    if (const AdaptiveGrid* grid = field.adaptive()) {
      vectors.adaptive.emplace(*grid, 0.0);
    } else if (field.grid()) {
      vectors.uniform.emplace(*field.grid(), 0.0);
    } else {
      return nullptr;
    }
    return &vectors;
  }

  const LaneBox& box() const {
    if (adaptive) return *adaptive;
    return *uniform;
  }
};

void SphereSides::begin(const Chord& chord) {
  chord_ = &chord;
  if (vectors_) vectors_->sweep.emplace(field_, vectors_->box(), chord, margins_, shell_);
}

bool SphereSides::sortsPoints() const {
  return vectors_ && !vectors_->sweep->isLong();
}

void SphereSides::testGroup() {
  if (vectors_->adaptive) {
    sweepSpheres(*vectors_->adaptive, *vectors_->sweep, group_, vectors_->work);
  } else {
    sweepSpheres(*vectors_->uniform, *vectors_->sweep, group_, vectors_->work);
  }
}

#else

struct SphereSides::Vectors {
  static Vectors* of(const DistanceField& /*field*/) { return nullptr; }
};

void SphereSides::begin(const Chord& chord) {
  chord_ = &chord;
}

bool SphereSides::sortsPoints() const {
  return false;
}

void SphereSides::testGroup() {
  for (int i = 0; i < group_.size; ++i) group_.side[i] = static_cast<std::int32_t>(SweptSide::kUnknown);
}

#endif

SphereSides::SphereSides(const DistanceField& field, const SweptMargins& margins, const BoundingBall& shell)
    : field_(field), margins_(margins), shell_(shell), group_(threadGroup()), vectors_(Vectors::of(field)) {}

SweptSide SphereSides::of(const Vector3d& center_P, double radius) const {
  return sweptSide(field_, along(*chord_, center_P), {radius + margins_.outside, radius + margins_.inside});
}

}  // namespace sdf_ccd
