#include "pair_roles.h"

#include <algorithm>

#include "common/infinity.h"
#include "contact/role_weight.h"

namespace sdf_ccd {

PairRoles::PairRoles(const Scene& scene, const PlannedPair& pair) : body_b_(pair.body_b), finest_spacing_(kInfinity) {
  const auto addRole = [&](int shell, int field) {
    const PairRole role(scene, shell, field);
    if (role.shell().size() == 0 || role.field().parts.empty()) return;
    finest_spacing_ = std::min(finest_spacing_, role.shell().covering_radius);
    roles_.push_back(role);
  };
  if (pair.a_shell_b_field) addRole(pair.body_a, pair.body_b);
  if (pair.b_shell_a_field) addRole(pair.body_b, pair.body_a);
}

void PairRoles::setMotion(const SweptBodies& bodies, const WaypointSpan& span, Memory& memory) {
  travel_ = kInfinity;
  pose_error_ = 0.0;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    PairRole& role = roles_[i];
    role.setMotion(bodies, span, memory[i]);
    travel_ = std::min(travel_, role.motion().travel());
    pose_error_ = std::max(pose_error_, role.motion().poseError() + role.shell().position_error);
  }
}

double PairRoles::cut(const ChordOptions& options) {
  double error = 0.0;
  for (PairRole& role : roles_) {
    role.cut(options);
    error = std::max(error, role.path().error);
  }
  return error;
}

void PairRoles::addContacts(const std::vector<ContactCollector::BodyData>& bodies, const ContactOptions& options,
                            bool with_impulse, ContactCollector& collector) {
  const auto weight = [&](const PairRole& role) { return roleWeight(role.shell().covering_radius, finest_spacing_); };
  double all = 0.0;
  for (const PairRole& role : roles_) all += weight(role);
  for (PairRole& role : roles_)
    collector.add(role, role.fieldBody() == body_b_, weight(role) / all, bodies, options, with_impulse);
}

}  // namespace sdf_ccd
