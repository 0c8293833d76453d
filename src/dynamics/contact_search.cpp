#include "contact_search.h"

#include <algorithm>
#include <cmath>

#include "contact/role_weight.h"
#include "dynamics/collision_shape.h"

namespace sdf_ccd {
namespace {

/// Distance of the origin from a segment [m].
double distanceOfOrigin(const Vector3d& start, const Vector3d& end) {
  const Vector3d d = end - start;
  const double along = d.squaredNorm();
  const double s = along > 0.0 ? std::clamp(-start.dot(d) / along, 0.0, 1.0) : 0.0;
  return (start + s * d).norm();
}

}  // namespace

ContactSearch::ContactSearch(const RigidWorld& world) : world_(world) {
  const int count = static_cast<int>(world.bodies.size());
  const auto canTest = [&](int shell, int field) {
    return world.bodies[shell].shape->shell.size() > 0 && world.bodies[field].shape->field.has_value();
  };
  const auto spacing = [&](int body) { return world.bodies[body].shape->shell.covering_radius; };
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      if (world.bodies[a].fixed && world.bodies[b].fixed) continue;
      const double finest = std::min(spacing(a), spacing(b));
      const double weight_a = canTest(a, b) ? roleWeight(spacing(a), finest) : 0.0;
      const double weight_b = canTest(b, a) ? roleWeight(spacing(b), finest) : 0.0;
      if (weight_a > 0.0) roles_.push_back({a, b, weight_a / (weight_a + weight_b)});
      if (weight_b > 0.0) roles_.push_back({b, a, weight_b / (weight_a + weight_b)});
    }
  }
}

bool ContactSearch::mayMeet(const Role& role, const StepMotion& motion) const {
  const CollisionShape& shell = *world_.bodies[role.shell_body].shape;
  const CollisionShape& field = *world_.bodies[role.field_body].shape;
  const std::vector<Isometry3d>& X_OP = motion.X_OB[role.shell_body];
  const std::vector<Isometry3d>& X_OF = motion.X_OB[role.field_body];
  if (std::isinf(field.ball.radius)) {
    // A fixed plane, and the shell's centre moves on a straight line: their distance is smallest at an end.
    const auto distance = [&](std::size_t k) {
      return field.field->lowerBound(relativePose(X_OF[k], X_OP[k]).translation());
    };
    return std::min(distance(0), distance(X_OP.size() - 1)) <= shell.ball.radius;
  }
  return distanceOfOrigin(X_OP.front().translation() - X_OF.front().translation(),
                          X_OP.back().translation() - X_OF.back().translation()) <=
         shell.ball.radius + field.ball.radius;
}

void ContactSearch::run(const StepMotion& motion, const std::function<void(const RoleHits&)>& visit) {
  for (const Role& role : roles_) {
    if (!mayMeet(role, motion)) continue;
    const CollisionShape& shell = *world_.bodies[role.shell_body].shape;
    ChordOptions chords;
    chords.tolerance = world_.chord_tolerance * std::max(shell.ball.radius, 1e-9);
    path_.chords.clear();
    path_.error = 0.0;
    const std::vector<Isometry3d>&X_OF = motion.X_OB[role.field_body], &X_OP = motion.X_OB[role.shell_body];
    for (std::size_t k = 0; k + 1 < motion.times.size(); ++k) {
      addChords({motion.times[k], motion.times[k + 1], X_OF[k], X_OF[k + 1], X_OP[k], X_OP[k + 1]}, shell.ball, chords,
                static_cast<int>(k), path_);
    }
    shellIntervals(*world_.bodies[role.field_body].shape->field, shell.shell, shell.tree, path_, query_);
    if (!query_.touches()) continue;
    listHits(query_, hits_);
    visit({role.shell_body, role.field_body, role.weight, chords.tolerance, path_, hits_});
  }
}

}  // namespace sdf_ccd
