#include "ros/monitor/ways_out_message.h"

#include "monitor/pair_traits.h"
#include "robot_monitor/ways_out.h"
#include "ros/tf/robot_frames.h"

namespace sdf_ccd {

WaysOut toWaysOut(const MonitorLoop& loop, const SafetyRules& rules) {
  WaysOut message;
  message.header.stamp = loop.cycle().end;
  message.header.frame_id = loop.fixedFrame();
  const DescribedScene& described = loop.robot();
  std::vector<ClosePair> pairs;
  const auto linkOf = [&](int body) {
    return described.robot ? described.frames().linkOf(loop.scene().bodies[body].frame) : -1;
  };
  for (const PairDistance& pair : loop.distances()) {
    if (!isTooClose(pair, rules)) continue;
    pairs.push_back({linkOf(pair.body_a), linkOf(pair.body_b), pair.p_A_W, pair.p_B_W, pair.normal_W});
    WayOut& listed = message.ways.emplace_back();
    listed.body_a = loop.scene().bodies[pair.body_a].name;
    listed.body_b = loop.scene().bodies[pair.body_b].name;
    listed.distance = pair.distance;
    listed.stop_distance = traitsOf(pair, rules.traits).stop_distance.value_or(rules.thresholds.stop);
  }
  if (pairs.empty() || !described.robot) return message;
  const auto linkPose = [&](int link) -> std::optional<Isometry3d> {
    Isometry3d X_WL;
    std::string problem;
    const bool is_known = loop.history().lookup(described.frames()(link), loop.cycle().complete_until, X_WL, problem);
    return is_known ? std::optional<Isometry3d>(X_WL) : std::nullopt;
  };
  const std::vector<std::vector<SeparatingJoint>> joints = waysOut(*described.robot, pairs, linkPose);
  for (std::size_t p = 0; p < joints.size(); ++p) {
    for (const SeparatingJoint& joint : joints[p]) {
      WayOutJoint& listed = message.ways[p].joints.emplace_back();
      listed.name = joint.joint;
      listed.rate = joint.rate;
    }
  }
  return message;
}

}  // namespace sdf_ccd
