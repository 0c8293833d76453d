#include "pair_roles.h"

#include <algorithm>

#include "common/infinity.h"
#include "contact/role_weight.h"

namespace sdf_ccd {

PairRoles::PairRoles(const Scene& scene, const PlannedPair& pair) : body_b_(pair.body_b) {
  std::size_t wanted = 0;
  const auto addRole = [&](int shell, int field, ShellPurpose purpose) {
    ++wanted;
    PairRole role(scene, shell, field, purpose);
    if (role.shell().size() > 0 && !scene.bodies[field].parts.empty()) roles_.push_back(role);
  };
  const auto purpose = [](bool edges_only) { return edges_only ? ShellPurpose::kEdges : ShellPurpose::kSurface; };
  if (pair.a_shell_b_field) addRole(pair.body_a, pair.body_b, purpose(pair.a_edges_only));
  if (pair.b_shell_a_field) addRole(pair.body_b, pair.body_a, purpose(pair.b_edges_only));
  if (pair.a_witnesses_b_field) addRole(pair.body_a, pair.body_b, ShellPurpose::kWitnesses);
  if (pair.b_witnesses_a_field) addRole(pair.body_b, pair.body_a, ShellPurpose::kWitnesses);
  are_built_ = wanted > 0 && roles_.size() == wanted;
  finest_spacing_ = kInfinity;
  for (const PairRole& role : roles_)
    if (role.bearsForce()) finest_spacing_ = std::min(finest_spacing_, role.shell().covering_radius);
}

void PairRoles::setMotion(const SweptBodies& bodies, const WaypointSpan& span, Memory& memory) {
  travel_ = kInfinity;
  pose_error_ = 0.0;
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    PairRole& role = roles_[i];
    role.setMotion(bodies, span, memory[i]);
    if (role.ballHoldsBody()) travel_ = std::min(travel_, role.motion().travel());
    pose_error_ = std::max(pose_error_, role.motion().poseError() + role.shell().position_error);
  }
}

double PairRoles::ballClearance() const {
  double clearance = -kInfinity;
  for (const PairRole& role : roles_)
    if (role.ballHoldsBody())
      clearance = std::max(clearance, role.ballClearance(role.motion().start()) - role.motion().travel());
  return clearance;
}

std::optional<double> PairRoles::clearanceByBalls(double margin) const {
  for (const PairRole& role : roles_) {
    const RelativeMotion& motion = role.motion();
    if (role.ballHoldsBody() && role.ballClearance(motion.start()) - motion.travel() > margin)
      return role.ballClearance(motion.end());
  }
  return std::nullopt;
}

double PairRoles::cut(const ChordOptions& options) {
  double error = 0.0;
  for (PairRole& role : roles_) {
    role.cut(options);
    error = std::max(error, role.path().error);
  }
  return error;
}

bool PairRoles::mayComeNearer(double distance) {
  return std::any_of(roles_.begin(), roles_.end(), [&](PairRole& role) { return role.mayComeNearer(distance); });
}

double PairRoles::pointClearanceAtEnd(double slack) const {
  double clearance = kInfinity;
  for (const PairRole& role : roles_) clearance = std::min(clearance, role.pointClearanceAtEnd(slack));
  return clearance;
}

bool PairRoles::isOutsideAtEnd(int body) const {
  const auto role =
      std::find_if(roles_.begin(), roles_.end(), [&](const PairRole& role) { return role.fieldBody() == body; });
  return role != roles_.end() && role->isOutsideAtEnd();
}

double PairRoles::forceWeight(const PairRole& role) const {
  return role.bearsForce() ? roleWeight(role.shell().covering_radius, finest_spacing_) : 0.0;
}

void PairRoles::addContacts(const std::vector<ContactCollector::BodyData>& bodies, const ContactOptions& options,
                            bool with_impulse, ContactCollector& collector) {
  double all = 0.0;
  for (const PairRole& role : roles_) all += forceWeight(role);
  for (PairRole& role : roles_) {
    collector.add(role, role.fieldBody() == body_b_, forceWeight(role) / all, bodies, options,
                  with_impulse && role.bearsForce());
  }
}

}  // namespace sdf_ccd
