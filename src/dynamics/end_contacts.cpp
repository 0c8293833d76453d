#include "end_contacts.h"

#include <algorithm>

#include "dynamics/collision_shape.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

/// Gradient of the interpolated field; where it is unknown, far inside, the shell's inward normal.
Vector3d slopeAt(const FieldValue& sample, const Vector3d& inward_F) {
  return sample.gradient.norm() > 1e-9 ? sample.gradient : inward_F;
}

class EndContacts {
 public:
  EndContacts(const RigidWorld& world, const StepMotion& motion, const RoleHits& role)
      : options_(world.contact),
        role_(role),
        shell_(world.bodies[role.shell_body].shape->shell),
        field_(*world.bodies[role.field_body].shape->field),
        R_OF_(motion.X_OB[role.field_body].back().linear()),
        duration_(motion.times.back()) {}

  /// The contact of one point, from its hits in order of time.
  PointContact operator()(const ShellHit* first, const ShellHit* last) const {
    const Chord& end = role_.path.chords.back();
    const int point = first->point;
    const Vector3d p_F = end.X_FP_end * shell_.point(point);
    const Vector3d r_P_F = end.X_FP_end.linear() * shell_.point(point);
    const Vector3d inward_F = -(end.X_FP_end.linear() * shell_.normal(point));
    const double share = options_.stiffness_per == StiffnessPer::kArea ? double(shell_.areas[point]) : 1.0;
    const FieldValue at_end = field_.interpolate(p_F);

    PointContact contact;
    contact.stiffness = role_.weight * share * options_.stiffness;
    contact.damping = role_.weight * share * options_.damping * timeInside(first, last);
    contact.depth = std::min(at_end.value, 0.0);
    contact.gap = contact.depth;
    contact.inward = R_OF_ * inward_F;
    contact.r_P = R_OF_ * r_P_F;
    contact.r_F = R_OF_ * p_F;
    Vector3d slope_F = slopeAt(at_end, inward_F);
    const bool stood_still = end.X_FP_end.matrix() == role_.path.chords.front().X_FP_start.matrix();
    for (const ShellHit* hit = first; hit <= last && !stood_still;) {
      const ShellHit* const left = lastOfStay(hit, last);
      const Vector3d entry_F = pointAt(*hit, hit->interval.enter);
      const FieldValue at_entry = field_.interpolate(entry_F);
      const Vector3d normal_F = slopeAt(at_entry, inward_F).normalized();
      const double behind = std::min(at_entry.value, 0.0) + normal_F.dot(p_F - entry_F);
      if (behind < contact.gap && isHeld(hit, left, contact.gap - behind, normal_F, inward_F)) {
        contact.gap = behind;
        slope_F = normal_F;
        break;
      }
      hit = left + 1;
    }
    contact.slope = R_OF_ * slope_F;
    return contact;
  }

 private:
  Vector3d pointAt(const ShellHit& hit, double s) const {
    const Chord& chord = role_.path.chords[hit.chord];
    const Vector3d p_P = shell_.point(hit.point);
    return (1.0 - s) * (chord.X_FP_start * p_P) + s * (chord.X_FP_end * p_P);
  }

  /// The hits of one stay inside: the next begins where the one before ends, on the next chord.
  static const ShellHit* lastOfStay(const ShellHit* hit, const ShellHit* last) {
    constexpr double kSame = 1e-6;  // of a chord
    while (hit < last && hit[1].chord == hit->chord + 1 && hit->interval.exit > 1.0 - kSame &&
           hit[1].interval.enter < kSame) {
      ++hit;
    }
    return hit;
  }

  /// Whether the plane of its entry holds a point that is farther behind it, by `more`, than the field tells: it left
  /// by an opposite face, or was deeper than by what a path beside an edge can be off. (The middle of a chord's piece
  /// in a convex solid has at least half of its greatest depth.)
  bool isHeld(const ShellHit* first, const ShellHit* last, double more, const Vector3d& normal_F,
              const Vector3d& inward_F) const {
    const double graze = role_.tolerance + field_.errorBound();
    for (const ShellHit* hit = first; hit <= last && more > graze; ++hit) {
      const double middle = 0.5 * (hit->interval.enter + hit->interval.exit);
      if (field_.interpolate(pointAt(*hit, middle)).value < -graze) return true;
    }
    return slopeAt(field_.interpolate(pointAt(*last, last->interval.exit)), inward_F).dot(normal_F) < 0.0;
  }

  double timeInside(const ShellHit* first, const ShellHit* last) const {
    double time = 0.0;
    for (const ShellHit* hit = first; hit <= last; ++hit) {
      const Chord& chord = role_.path.chords[hit->chord];
      time += (hit->interval.exit - hit->interval.enter) * (chord.t_end - chord.t_start);
    }
    return time / duration_;
  }

  const ContactOptions& options_;
  const RoleHits& role_;
  const PointShell& shell_;
  const DistanceField& field_;
  const Matrix3d R_OF_;
  const double duration_;
};

}  // namespace

void endContacts(const RigidWorld& world, const StepMotion& motion, ContactSearch& search,
                 std::vector<PairContacts>& contacts) {
  contacts.clear();
  std::vector<ShellHit> hits;
  search.run(motion, [&](const RoleHits& role) {
    hits = role.hits;
    std::stable_sort(hits.begin(), hits.end(), [](const ShellHit& a, const ShellHit& b) { return a.point < b.point; });
    const EndContacts contactOf(world, motion, role);
    PairContacts pair{role.shell_body,
                      role.field_body,
                      motion.X_OB[role.shell_body].back().translation(),
                      motion.X_OB[role.field_body].back().translation(),
                      {}};
    for (std::size_t i = 0; i < hits.size();) {
      std::size_t last = i;
      while (last + 1 < hits.size() && hits[last + 1].point == hits[i].point) ++last;
      pair.points.push_back(contactOf(&hits[i], &hits[last]));
      i = last + 1;
    }
    contacts.push_back(std::move(pair));
  });
}

void contactsAtRest(const RigidWorld& world, const std::vector<BodyState>& states, ContactSearch& search,
                    std::vector<PairContacts>& contacts) {
  StepMotion motion;
  restMotion(states, 1.0, motion);
  endContacts(world, motion, search, contacts);
}

double elasticEnergy(const PairContacts& contacts) {
  double energy = 0.0;
  for (const PointContact& point : contacts.points) energy += 0.5 * point.stiffness * point.depth * point.depth;
  return energy;
}

double elasticEnergy(const std::vector<PairContacts>& contacts) {
  double energy = 0.0;
  for (const PairContacts& pair : contacts) energy += elasticEnergy(pair);
  return energy;
}

}  // namespace sdf_ccd
