#include "ros/monitor/plan_message.h"

#include "scene/plan/scene_totals.h"

namespace sdf_ccd {
namespace {

constexpr bool isKind(PairKind kind, int of_message) {
  return static_cast<int>(kind) == of_message;
}
static_assert(isKind(PairKind::kRequest, LeftOutPair::REQUEST) &&
                  isKind(PairKind::kTouchLinks, LeftOutPair::TOUCH_LINKS) &&
                  isKind(PairKind::kUser, LeftOutPair::USER) && isKind(PairKind::kSrdf, LeftOutPair::SRDF) &&
                  isKind(PairKind::kRigid, LeftOutPair::RIGID) && isKind(PairKind::kAdjacent, LeftOutPair::ADJACENT) &&
                  isKind(PairKind::kEmpty, LeftOutPair::EMPTY) && isKind(PairKind::kNever, LeftOutPair::NEVER) &&
                  isKind(PairKind::kAlways, LeftOutPair::ALWAYS) && isKind(PairKind::kHeld, LeftOutPair::HELD) &&
                  isKind(PairKind::kAtRest, LeftOutPair::AT_REST) &&
                  isKind(PairKind::kHeldAtRest, LeftOutPair::HELD_AT_REST) &&
                  isKind(PairKind::kMayAtRest, LeftOutPair::MAY_AT_REST),
              "as in the messages");

constexpr bool isState(PartState state, int of_message) {
  return static_cast<int>(state) == of_message;
}
static_assert(isState(PartState::kNotNeeded, PlanPart::NOT_NEEDED) && isState(PartState::kReady, PlanPart::READY) &&
                  isState(PartState::kAwaited, PlanPart::AWAITED) &&
                  isState(PartState::kUnwanted, PlanPart::NOT_WANTED) && isState(PartState::kFailed, PlanPart::FAILED),
              "as in the messages");

PlanPart toPlanPart(const PartReport& part) {
  PlanPart message;
  message.state = static_cast<std::uint8_t>(part.state);
  message.text = part.text;
  return message;
}

}  // namespace

Plan toPlan(const CheckedWorld& world, const std::string& fixed_frame, const ros::Time& now) {
  const Scene& scene = world.scene();
  Plan plan;
  plan.header.stamp = now;
  plan.header.frame_id = fixed_frame;
  plan.scene_version = world.version();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const BodyReport& report = scene.reports[b];
    PlanBody& listed = plan.bodies.emplace_back();
    listed.name = body.name;
    listed.id = b < world.snapshot->body_ids.size() ? world.snapshot->body_ids[b] : b + 1;
    listed.frame = body.frame;
    listed.is_world = static_cast<std::uint8_t>(body.is_world);
    listed.geometry = report.geometry;
    listed.failure = body.failure;
    listed.error_bound = report.bound.total();
    listed.surface = toPlanPart(report.surface);
    listed.field = toPlanPart(report.field);
    listed.shell = toPlanPart(report.shell);
    listed.shell_points = static_cast<std::uint32_t>(report.shell_points);
    listed.bytes = report.field_bytes + report.shell_bytes;
    for (const std::string& warning : report.warnings) plan.warnings.push_back(report.name + ": " + warning);
  }
  for (const PlannedPair& pair : scene.pairs) {
    PlanPair& checked = plan.checked.emplace_back();
    checked.body_a = static_cast<std::uint32_t>(pair.body_a);
    checked.body_b = static_cast<std::uint32_t>(pair.body_b);
  }
  for (const PairDecision& pair : scene.left_out) {
    LeftOutPair& left_out = plan.left_out.emplace_back();
    left_out.body_a = static_cast<std::uint32_t>(pair.a);
    left_out.body_b = static_cast<std::uint32_t>(pair.b);
    left_out.kind = static_cast<std::uint8_t>(pair.kind);
    left_out.reason = pair.text;
    left_out.depth = pair.depth;
  }
  plan.pairs_of_objects = pairsOfObjects(scene.bodies);
  plan.visual_only = scene.visual_only;
  for (const auto* some : {&scene.warnings, &scene.overlap_notes})
    plan.warnings.insert(plan.warnings.end(), some->begin(), some->end());
  plan.error_bound = scene.bound.total();
  plan.max_error = scene.max_error.value_or(0.0);
  plan.seconds = world.snapshot->seconds > 0.0 ? world.snapshot->seconds : scene.build_seconds;
  return plan;
}

}  // namespace sdf_ccd
