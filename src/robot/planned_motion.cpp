#include "sdf_ccd/trajectory.h"

#include <memory>
#include <stdexcept>

#include "motion/motion_sampling.h"
#include "motion/screw_motion.h"
#include "motion/validate_motion.h"
#include "robot/planned_motion.h"
#include "robot/trajectory_motion.h"

namespace sdf_ccd {
namespace {

std::vector<double> fromZero(std::vector<double> times) {
  const double start = times.front();
  for (double& time : times) time -= start;
  return times;
}

void startAtZero(CycleMotion& motion) {
  motion.times = fromZero(std::move(motion.times));
}

[[noreturn]] void refusePlan(const std::string& what) {
  throw std::invalid_argument("planned motion: " + what);
}

/// Resizes optional vectors to the number of bodies. @throws std::invalid_argument if sizes are inconsistent.
void complete(CycleMotion& motion) {
  if (!motion.spans.empty()) refusePlan("spans are of cycles");
  MotionShape shape;
  for (std::size_t body = 0; body < motion.X_WB.size(); ++body) shape.bodies.push_back("body " + std::to_string(body));
  validate(motion, shape, "planned motion");
  motion.missing.resize(shape.bodies.size());
  for (std::size_t body = 0; body < shape.bodies.size(); ++body) {
    if (motion.missing[body].empty()) {
      motion.X_WB[body].resize(motion.times.size(), Isometry3d(motion.X_WB[body].front()));
      requireUnambiguousTurns(motion.X_WB[body], "planned motion: " + shape.bodies[body]);
    } else {
      motion.X_WB[body].resize(motion.times.size(), Isometry3d::Identity());  // not read
    }
  }
}

}  // namespace

PlannedMotion planAlong(const RobotModel& robot, const PlannedJoints& plan, const PlannedBodies& bodies,
                        const MotionSampling& sampling) {
  if (plan.missing.size() != robot.links().size()) refusePlan("a plan that completePlan() has not made");
  if (!bodies.missing.empty() && bodies.missing.size() != bodies.bodies.size())
    refusePlan(std::to_string(bodies.missing.size()) + " reasons for " + std::to_string(bodies.bodies.size()) +
               " bodies");
  PlannedMotion result;
  result.samples = fromZero(plan.trajectory.times);
  result.assumed = plan.assumed;
  std::vector<std::string> missing = bodies.missing;
  missing.resize(bodies.bodies.size());
  std::vector<BoundingBall> balls;
  for (std::size_t i = 0; i < bodies.bodies.size(); ++i) {
    const CarriedBody& body = bodies.bodies[i];
    balls.push_back(body.ball_B);
    if (body.link >= 0 && missing[i].empty()) missing[i] = plan.missing[body.link];
  }
  const auto along = std::make_shared<TrajectoryMotion>(robot, plan.trajectory, bodies.bodies);
  const std::vector<double> waypoints = along->waypoints();
  result.waypoints = fromZero(waypoints);
  result.piece = [along, waypoints, missing, balls, sampling, errors = along->jointErrors()](
                     std::size_t first, std::size_t last, CycleMotion& motion) {
    motion.missing = missing;
    sampleMotion({waypoints.begin() + first, waypoints.begin() + last + 1}, along->source(), balls, sampling, motion);
    for (std::size_t body = 0; body < errors.size(); ++body) motion.motion_error[body] += errors[body];
    startAtZero(motion);
  };
  return result;
}

PlannedMotion planThrough(CycleMotion motion) {
  complete(motion);
  PlannedMotion result;
  result.samples = result.waypoints = fromZero(motion.times);
  const auto whole = std::make_shared<const CycleMotion>(std::move(motion));
  result.piece = [whole](std::size_t first, std::size_t last, CycleMotion& piece) {
    piece.missing = whole->missing;
    piece.motion_error = whole->motion_error;
    piece.spans.clear();
    piece.times.assign(whole->times.begin() + first, whole->times.begin() + last + 1);
    piece.X_WB.resize(whole->X_WB.size());
    for (std::size_t body = 0; body < piece.X_WB.size(); ++body) {
      const std::vector<Isometry3d>& poses = whole->X_WB[body];
      piece.X_WB[body].assign(poses.begin() + first, poses.begin() + last + 1);
    }
    startAtZero(piece);
  };
  return result;
}

}  // namespace sdf_ccd
