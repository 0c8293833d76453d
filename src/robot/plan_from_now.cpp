#include "robot/plan_from_now.h"

#include <map>

#include "common/counted.h"
#include "common/refuse.h"
#include "motion/motion_sampling.h"
#include "motion/screw_motion.h"
#include "robot/planned_motion.h"

namespace sdf_ccd {
namespace {

std::vector<std::string> notesOn(const PlannedJoints& plan, const std::string& known_by) {
  constexpr std::size_t kMost = 5;
  std::vector<std::string> notes, names;
  for (const AssumedJoint& joint : plan.assumed) names.push_back(joint.name);
  if (!names.empty())
    notes.push_back("not named, hence assumed to stay where " + known_by +
                    " has them: " + counted(names.size(), "joint") + ", " + firstOf(names, kMost));
  for (const std::string& beyond : plan.beyond_limits) notes.push_back("where " + known_by + " has it, " + beyond);
  return notes;
}

/// The named links, by their indices in the robot, with their places in the plan.
std::map<int, std::size_t> placesOf(const RobotModel& robot, const LinkPlan& plan) {
  std::map<int, std::size_t> places;
  for (std::size_t i = 0; i < plan.links.size(); ++i) {
    const int link = robot.find(plan.links[i]);
    if (link < 0) refuse("the robot has no link " + plan.links[i]);
    if (!places.emplace(link, i).second) refuse("link " + plan.links[i] + " is named twice");
    requireUnambiguousTurns(plan.X_WL[i], "link " + plan.links[i]);
  }
  return places;
}

}  // namespace

PlannedMotion planFromNow(const RobotModel& robot, const JointPlan& plan, const PresentState& now,
                          const PlanRules& rules, const MotionSampling& sampling) {
  RobotTrajectory named = plan.named;
  if (!plan.moves_root)
    for (RobotState& state : named.states) state.X_WR = now.X_WR;
  const PlannedJoints joints = completePlan(robot, named, now.joints, rules);
  PlannedBodies bodies = now.bodies;
  bodies.missing.resize(bodies.bodies.size());
  for (std::size_t body = 0; body < bodies.bodies.size(); ++body)
    if (bodies.bodies[body].link >= 0) bodies.missing[body] = plan.moves_root ? plan.root_missing : now.root_missing;
  PlannedMotion motion = planAlong(robot, joints, bodies, sampling);
  motion.notes = notesOn(joints, now.known_by);
  return motion;
}

PlannedMotion planFromNow(const RobotModel& robot, const LinkPlan& plan, const PresentState& now) {
  const std::map<int, std::size_t> places = placesOf(robot, plan);
  // Poses are known up to different times: the other links are where the joints are, each at its own time.
  const PlannedJoints rest = completePlan(robot, {{0.0}, {RobotState()}}, now.joints, {});
  const std::vector<Isometry3d> X_RL = robot.forwardKinematics({}, rest.trajectory.states.front().poses);
  CycleMotion motion;
  motion.times = plan.times;
  motion.missing = now.bodies.missing;
  motion.missing.resize(now.bodies.bodies.size());
  for (std::size_t b = 0; b < now.bodies.bodies.size(); ++b) {
    const CarriedBody& body = now.bodies.bodies[b];
    std::vector<Isometry3d>& X_WB = motion.X_WB.emplace_back();
    const auto place = places.find(body.link);
    if (body.link < 0) {
      X_WB.push_back(body.X_LB);
    } else if (place == places.end()) {
      const auto link = static_cast<std::size_t>(body.link);
      X_WB.push_back(now.X_WR * X_RL[link] * body.X_LB);
      motion.missing[b] = now.root_missing.empty() ? rest.missing[link] : now.root_missing;
    } else {
      for (const Isometry3d& X_WL : plan.X_WL[place->second]) X_WB.push_back(X_WL * body.X_LB);
      motion.missing[b].clear();
    }
  }
  return planThrough(std::move(motion));
}

}  // namespace sdf_ccd
