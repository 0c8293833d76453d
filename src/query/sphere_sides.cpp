#include "sphere_sides.h"

#include "field/field_access.h"
#include "query/swept_side.h"
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
    if (const AdaptiveGrid* grid = FieldAccess::adaptive(field)) {
      vectors.adaptive.emplace(*grid, 0.0);
    } else if (FieldAccess::grid(field)) {
      vectors.uniform.emplace(*FieldAccess::grid(field), 0.0);
    } else {
      return nullptr;
    }
    return &vectors;
  }

  const LaneBox& box() const {
    if (adaptive) return *adaptive;
    return *uniform;
  }

  void begin(const DistanceField& field, const Chord& chord, double margin, const BoundingBall& shell) {
    sweep.emplace(field, box(), chord, margin, shell);
  }

  bool sortsPoints() const { return !sweep->isLong(); }

  void test(SphereGroup& group) {
    if (adaptive) {
      sweepSpheres(*adaptive, *sweep, group, work);
    } else {
      sweepSpheres(*uniform, *sweep, group, work);
    }
  }
};

#else

struct SphereSides::Vectors {
  static Vectors* of(const DistanceField& /*field*/) { return nullptr; }
  void begin(const DistanceField& /*field*/, const Chord& /*chord*/, double /*margin*/, const BoundingBall& /*shell*/) {
  }
  bool sortsPoints() const { return false; }
  void test(SphereGroup& /*group*/) {}
};

#endif

SphereSides::SphereSides(const DistanceField& field, double margin, const BoundingBall& shell)
    : field_(field), margin_(margin), shell_(shell), group_(threadGroup()), vectors_(Vectors::of(field)) {}

void SphereSides::begin(const Chord& chord) {
  chord_ = &chord;
  if (const Primitive* primitive = field_.primitive()) primitive_.emplace(*primitive, chord, margin_, shell_);
  if (vectors_) vectors_->begin(field_, chord, margin_, shell_);
}

SweptSide SphereSides::of(const Vector3d& center_P, double radius) const {
  return sweptSide(field_, along(*chord_, center_P), radius + margin_);
}

bool SphereSides::sortsPoints() const {
  return primitive_ || (vectors_ && vectors_->sortsPoints());
}

void SphereSides::testGroup() {
  if (primitive_) {
    primitive_->test(group_);
  } else if (vectors_) {
    vectors_->test(group_);
  } else {
    for (int i = 0; i < group_.size; ++i) group_.side[i] = static_cast<std::int32_t>(SweptSide::kUnknown);
  }
}

}  // namespace sdf_ccd
