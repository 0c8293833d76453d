#include "pair_force.h"

#include <algorithm>

#include "common/infinity.h"
#include "contact/role_weight.h"
#include "pair_result.h"
#include "scene/pair_bound.h"
#include "shell/point_shell.h"

namespace sdf_ccd {
namespace {

constexpr double kRootTolerance = 1e-9;  // relative to the path; guaranteed by segmentIntervals()

std::string whyNoForce(const Body& a, const Body& b) {
  for (const Body* body : {&a, &b})
    if (body->forces != Forces::kKnown) return "no force: " + body->name + ": " + whyNoForces(body->forces);
  return "no force: neither body has a shell";
}

}  // namespace

PairForce::PairForce(const MonitoredBody& a, const MonitoredBody& b, const PlannedPair& pair)
    : finest_spacing_(kInfinity), bound_(contactBound(*a.body, *b.body, pair)) {
  const auto addRole = [&](const MonitoredBody& shell, const MonitoredBody& field, bool shell_is_a) {
    if (shell.body->shell->size() == 0 || field.body->parts.empty()) return;
    finest_spacing_ = std::min(finest_spacing_, shell.body->shell->covering_radius);
    roles_.emplace_back(shell, field, shell_is_a);
  };
  if (pair.a_shell_b_field) addRole(a, b, true);
  if (pair.b_shell_a_field) addRole(b, a, false);
  if (roles_.empty()) why_none_ = whyNoForce(*a.body, *b.body);
}

void PairForce::findContacts(const PairCycle& cycle, double given_error, bool crosses, PairResult& result) {
  ErrorSources error = bound_;
  error.chord = result.error.chord;
  double travel = kInfinity, pose_error = 0.0, chord_error = 0.0, all_weights = 0.0;
  const auto weight = [&](const PairRole& role) { return roleWeight(role.shell().covering_radius, finest_spacing_); };
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    PairRole& role = roles_[i];
    role.setMotion(cycle.motionOf(result), cycle.memory.roles[i]);
    role.cut(cycle.options.chords);
    travel = std::min(travel, role.motion().travel());
    pose_error = std::max(pose_error, role.motion().poseError() + role.shell().position_error);
    chord_error = std::max(chord_error, role.path().error);
    all_weights += weight(role);
  }
  if (!roles_.empty()) {
    error.root = kRootTolerance * travel;
    error.chord = chord_error + pose_error + given_error;
    requireFinite(error);
  }
  result.contact_error = error;
  ContactCollector& collector = cycle.memory.collector;
  collector.begin(cycle.motion, result, crosses);
  for (PairRole& role : roles_)
    collector.add(role, weight(role) / all_weights, cycle.options.contact, cycle.request.wrenches);
  collector.finish(cycle.request, result);
}

void PairForce::explainNone(PairResult& result) const {
  if (!roles_.empty()) return;
  setWrenchesUnknown(result);
  result.reason = why_none_;
}

}  // namespace sdf_ccd
