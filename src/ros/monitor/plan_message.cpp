#include "ros/monitor/plan_message.h"

#include <map>

#include "monitor/plan/scene_totals.h"

namespace sdf_ccd {

Plan toPlan(const CheckedWorld& world, const std::string& fixed_frame, const ros::Time& now) {
  const Scene& scene = world.scene();
  Plan plan;
  plan.header.stamp = now;
  plan.header.frame_id = fixed_frame;
  plan.scene_version = world.version();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const BodyReport& report = scene.reports[b];
    plan.names.push_back(body.name);
    plan.ids.push_back(b < world.snapshot->body_ids.size() ? world.snapshot->body_ids[b] : b + 1);
    plan.frames.push_back(body.frame);
    plan.is_world.push_back(static_cast<std::uint8_t>(body.is_world));
    plan.geometry.push_back(report.geometry);
    plan.fields.push_back(report.field);
    plan.bytes.push_back(report.field_bytes + report.shell_bytes);
    plan.shell_points.push_back(static_cast<std::uint32_t>(report.shell_points));
    plan.error_bounds.push_back(report.bound.total());
    plan.failures.push_back(body.failure);
    for (const std::string& warning : report.warnings) plan.warnings.push_back(report.name + ": " + warning);
  }
  for (const PlannedPair& pair : scene.pairs) {
    plan.pairs_a.push_back(static_cast<std::uint32_t>(pair.body_a));
    plan.pairs_b.push_back(static_cast<std::uint32_t>(pair.body_b));
  }
  constexpr std::size_t kMaxReasons = 65535;
  std::map<std::string, std::uint16_t> reasons;
  for (const PairDecision& pair : scene.left_out) {
    const bool is_full = plan.reasons.size() >= kMaxReasons;
    const auto [known, is_new] =
        reasons.emplace(is_full ? plan.reasons.back() : pair.text, static_cast<std::uint16_t>(plan.reasons.size()));
    if (is_new) plan.reasons.push_back(known->first);
    plan.left_out_a.push_back(static_cast<std::uint32_t>(pair.a));
    plan.left_out_b.push_back(static_cast<std::uint32_t>(pair.b));
    plan.left_out_reason.push_back(known->second);
    plan.left_out_depth.push_back(pair.depth);
  }
  for (const LeftOutPart& part : scene.parts_left_out) {
    plan.parts_left_out.push_back(part.kind + " of " + part.body);
    plan.part_reasons.push_back(part.reason);
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
