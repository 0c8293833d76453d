#include "ros/monitor/current_poses.h"

#include <algorithm>

#include "common/number_text.h"
#include "motion/two_body_motion.h"
#include "robot/planned_motion.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

/// Pose of a frame in one above it, at the last time at which its chain from the fixed frame is known.
/// @return why it is not known; empty if it is.
std::string poseAbove(const TfHistory& history, const std::string& above, const std::string& frame, Isometry3d& X_AF) {
  X_AF.setIdentity();
  if (above == frame) return {};
  const TfSpan span = history.span(frame);
  if (!span.problem.empty()) return span.problem;
  const ros::Time time = span.is_static ? ros::Time() : span.last;
  Isometry3d X_WA, X_WF;
  std::string problem;
  if (!history.lookup(above, time, X_WA, problem) || !history.lookup(frame, time, X_WF, problem)) return problem;
  X_AF = relativePose(X_WA, X_WF);
  return {};
}

}  // namespace

CurrentPoses currentPoses(const TfHistory& history, const RobotFrames& frames, const CheckedWorld& world) {
  const RobotModel& robot = frames.robot;
  CurrentPoses now;
  now.known_by = "tf";
  history.lookup(frames(0), ros::Time(), now.X_WR, now.root_missing);
  for (int link = 0; link < static_cast<int>(robot.links().size()); ++link) {
    const TfSpan span = history.span(frames(link));
    const bool moves = span.problem.empty() && !span.is_static;
    if (moves && (now.oldest.isZero() || span.last < now.oldest)) {
      now.oldest = span.last;
      now.oldest_frame = frames(link);
    }
    if (link == 0) continue;
    const std::string& joint = robot.jointAbove(link).name;
    Isometry3d X_PL;
    const std::string problem = poseAbove(history, frames(robot.parent(link)), frames(link), X_PL);
    if (problem.empty()) {
      now.joints.X_PL[joint] = X_PL;
    } else {
      now.joints.missing[joint] = problem;
    }
  }
  std::vector<Isometry3d> X_WB;
  posesAt(history, world.bodies, ros::Time(), X_WB, now.bodies.missing);
  for (std::size_t body = 0; body < world.bodies.size(); ++body) {
    CarriedBody& carried = now.bodies.bodies.emplace_back();
    carried.ball_B = world.bodies[body].ball_B;
    const std::string frame = withoutLeadingSlash(world.bodies[body].frame);
    std::vector<std::string> above = history.framesAbove(frame);
    above.insert(above.begin(), frame);
    int link = -1;
    const auto of_link =
        std::find_if(above.begin(), above.end(), [&](const auto& name) { return (link = frames.linkOf(name)) >= 0; });
    Isometry3d X_LF;
    const bool is_carried = of_link != above.end() && poseAbove(history, *of_link, frame, X_LF).empty();
    carried.link = is_carried ? link : -1;
    carried.X_LB = is_carried ? X_LF * world.bodies[body].X_frame_B : X_WB[body];
  }
  return now;
}

std::string oldTransformsNote(const CurrentPoses& now, const ros::Time& time, double max_age) {
  const double age = secondsBetween(now.oldest, time);
  if (now.oldest.isZero() || age <= max_age) return {};
  return "the newest transform of " + now.oldest_frame + " is " + numberText(age) + " s old";
}

}  // namespace sdf_ccd
