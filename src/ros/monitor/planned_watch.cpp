#include "ros/monitor/planned_watch.h"

#include <algorithm>
#include <cmath>

#include "motion/two_body_motion.h"
#include "robot/proof_watch.h"
#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {
namespace {

bool hasOneDegree(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS ||
         joint.type == urdf::Joint::PRISMATIC;
}

/// The motion with waypoints so close that no body turns by more than 3 degrees between two: ProofWatch compares
/// chords.
CycleMotion inSmallTurns(const CycleMotion& motion) {
  constexpr double kTurn = 0.05;  // [rad]
  CycleMotion small;
  small.missing = motion.missing;
  small.motion_error = motion.motion_error;
  small.X_WB.resize(motion.X_WB.size());
  small.times = {motion.times.front()};
  for (std::size_t body = 0; body < motion.X_WB.size(); ++body) small.X_WB[body].push_back(motion.pose(body, 0));
  for (std::size_t k = 1; k < motion.times.size(); ++k) {
    std::vector<ScrewMotion> screws;
    double angle = 0.0;
    for (std::size_t body = 0; body < motion.X_WB.size(); ++body) {
      screws.emplace_back(motion.pose(body, k - 1), motion.pose(body, k));
      angle = std::max(angle, screws.back().angle());
    }
    const int parts = std::max(1, static_cast<int>(std::ceil(angle / kTurn)));
    for (int i = 1; i <= parts; ++i) {
      const double s = static_cast<double>(i) / parts;
      small.times.push_back(motion.times[k - 1] + s * (motion.times[k] - motion.times[k - 1]));
      for (std::size_t body = 0; body < screws.size(); ++body) small.X_WB[body].push_back(screws[body].pose(s));
    }
  }
  return small;
}

void add(const UnreachablePair& pair, PlannedMotion& motion) {
  const auto isPair = [&](const UncheckedPair& known) {
    return known.body_a == pair.body_a && known.body_b == pair.body_b;
  };
  if (std::any_of(motion.unchecked.begin(), motion.unchecked.end(), isPair)) return;
  motion.unchecked.push_back({pair.body_a, pair.body_b, contradictionOf(pair)});
}

}  // namespace

bool doJointsDeviate(const RobotModel& robot, const CurrentJoints& joints) {
  constexpr double kRounding = 1e-5;  // [m, rad]
  JointPositions positions;
  for (const auto& [name, X_PL] : joints.X_PL) {
    const urdf::Joint& joint = *robot.urdf().getJoint(name);
    if (hasOneDegree(joint) && !joint.mimic) positions[name] = robot.positionAt(joint, X_PL);
  }
  const std::vector<Isometry3d> X_RL = robot.forwardKinematics(positions);
  for (int link = 1; link < static_cast<int>(X_RL.size()); ++link) {
    const urdf::Joint& joint = robot.jointAbove(link);
    const auto now = joints.X_PL.find(joint.name);
    if (now == joints.X_PL.end() || (!hasOneDegree(joint) && joint.type != urdf::Joint::FIXED)) continue;
    const Isometry3d expected = relativePose(X_RL[robot.parent(link)], X_RL[link]);
    if (!now->second.isApprox(expected, kRounding)) return true;
  }
  return false;
}

void addContradicted(const PlannedScene& planned, PlannedMotion& motion) {
  if (!planned.now.joints_deviate) return;
  ProofWatch watch(planned.unreachable, planned.description);
  CycleMotion piece;
  for (std::size_t i = 1; i < motion.waypoints.size(); ++i) {
    checkCancelled();
    motion.piece(i - 1, i, piece);
    const CycleMotion small = inSmallTurns(piece);
    const std::vector<char>& contradicted =
        watch.contradicted(small, std::vector<WaypointSpan>(planned.unreachable.size(), {0, small.times.size() - 1}));
    for (std::size_t p = 0; p < contradicted.size(); ++p)
      if (contradicted[p]) add(planned.unreachable[p], motion);
  }
}

void addContradicted(const PlannedScene& planned, const std::vector<bool>& is_moved, PlannedMotion& motion) {
  if (!planned.now.joints_deviate) return;
  // Frames of tf are known up to different times: poses on the robot are those of its joints, each at its own time.
  const RobotModel& robot = planned.robot;
  std::vector<Isometry3d> X_RL(robot.links().size(), Isometry3d::Identity());
  std::vector<std::string> missing(robot.links().size());
  for (int link = 1; link < static_cast<int>(X_RL.size()); ++link) {
    const std::string& joint = robot.jointAbove(link).name;
    const auto now = planned.now.joints.X_PL.find(joint);
    const bool is_known = now != planned.now.joints.X_PL.end();
    missing[link] = is_known ? missing[robot.parent(link)] : "no joint " + joint;
    if (is_known) X_RL[link] = X_RL[robot.parent(link)] * now->second;
  }
  CycleMotion now;
  now.times = {0.0, 1.0};
  for (const Carrier& carrier : planned.now.carriers) {
    const bool is_carried = carrier.link >= 0;
    now.X_WB.push_back({is_carried ? X_RL[carrier.link] * carrier.X_LB : Isometry3d::Identity()});
    now.missing.push_back(is_carried ? missing[carrier.link] : "not on the robot");
  }
  std::vector<WaypointSpan> spans;
  for (const UnreachablePair& pair : planned.unreachable)
    spans.push_back({0, is_moved[pair.body_a] || is_moved[pair.body_b] ? 0u : 1u});
  ProofWatch watch(planned.unreachable, planned.description);
  const std::vector<char>& contradicted = watch.contradicted(now, spans);
  for (std::size_t p = 0; p < contradicted.size(); ++p)
    if (contradicted[p]) add(planned.unreachable[p], motion);
}

}  // namespace sdf_ccd
