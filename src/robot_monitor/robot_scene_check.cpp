// Checks of a RobotScene's motions, with answers by name.

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/counted.h"
#include "common/infinity.h"
#include "motion/motion_sampling.h"
#include "robot/planned_motion.h"
#include "robot_monitor/robot_scene_impl.h"

namespace sdf_ccd {
namespace {

void requireStates(const RobotTrajectory& trajectory) {
  if (trajectory.times.size() != trajectory.states.size())
    throw std::invalid_argument("a trajectory of " + counted(trajectory.times.size(), "time") + " and " +
                                counted(trajectory.states.size(), "state"));
  if (trajectory.states.size() < 2)
    throw std::invalid_argument("a trajectory of " + counted(trajectory.states.size(), "waypoint") +
                                "; two or more are needed");
}

ContactPoint atTime(ContactPoint point, double start) {
  point.enter += start;
  point.exit += start;
  point.time += start;
  return point;
}

/// @param start  of the trajectory: times of the result count from there [s].
MotionPair byName(const PairResult& pair, const Scene& scene, double start) {
  MotionPair named;
  named.body_a = scene.bodies[static_cast<std::size_t>(pair.body_a)].name;
  named.body_b = scene.bodies[static_cast<std::size_t>(pair.body_b)].name;
  named.verdict = pair.verdict;
  named.reason = pair.reason;
  named.error_bound = pair.error.total();
  for (const Interval& interval : pair.intervals)
    named.contacts.push_back({start + interval.enter, start + interval.exit});
  if (pair.first_touch) named.first_contact = Interval{start + pair.first_touch->enter, start + pair.first_touch->exit};
  if (!pair.intervals.empty()) named.deepest = atTime(pair.deepest, start);
  for (const ContactPoint& point : pair.points) named.points.push_back(atTime(point, start));
  named.on_a_W = pair.on_a_W;
  named.on_b_W = pair.on_b_W;
  return named;
}

bool isBefore(const MotionPair& a, const MotionPair& b) {
  if (a.verdict != b.verdict) return isWorse(a.verdict, b.verdict);
  const auto begin = [](const MotionPair& pair) { return pair.contacts.empty() ? kInfinity : pair.contacts[0].enter; };
  return begin(a) < begin(b);
}

}  // namespace

PlannedMotion RobotScene::Impl::planned(const RobotTrajectory& trajectory, bool allow_beyond_limits,
                                        double tolerance) const {
  requireStates(trajectory);
  MotionSampling wanted;
  wanted.tolerance = tolerance;
  return planFromNow(robot, {trajectory, true, {}}, now, {allow_beyond_limits}, wanted);
}

const MotionPair* MotionResult::find(const std::string& body_a, const std::string& body_b) const {
  const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const MotionPair& pair) {
    return (pair.body_a == body_a && pair.body_b == body_b) || (pair.body_a == body_b && pair.body_b == body_a);
  });
  return found == pairs.end() ? nullptr : &*found;
}

MotionResult RobotScene::check(const RobotTrajectory& trajectory, const MotionCheckOptions& options) const {
  MotionResult result;
  const PlannedMotion motion = impl_->planned(trajectory, options.allow_beyond_limits, impl_->sampling);
  result.assumed = motion.assumed;
  result.notes = motion.notes;
  CycleRequest request;
  request.margin = options.margin;
  request.contacts = options.contacts;
  request.wrenches = options.contacts && options.wrenches;
  request.max_points = options.contacts ? options.max_points : 0;
  MotionCheck check(impl_->world->scene, impl_->monitor, motion, request, impl_->memory);
  while (!check.isDone()) check.next();
  const CycleResult checked = check.result();
  result.verdict = checked.verdict;
  result.error_bound = checked.error_bound;
  for (const PairResult& pair : checked.pairs)
    result.pairs.push_back(byName(pair, impl_->scene(), trajectory.times.front()));
  std::stable_sort(result.pairs.begin(), result.pairs.end(), isBefore);
  return result;
}

std::vector<MotionSummary> RobotScene::checkMotions(const std::vector<RobotTrajectory>& trajectories,
                                                    const MotionCheckOptions& options) const {
  MotionsRequest request;
  request.margin = options.margin;
  request.tolerances = {0.01, impl_->sampling};
  const auto motionOf = [&](std::size_t i, double tolerance) {
    try {
      return impl_->planned(trajectories[i], options.allow_beyond_limits, tolerance);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("motion " + std::to_string(i) + ": " + error.what());
    }
  };
  const std::vector<MotionVerdict> verdicts =
      sdf_ccd::checkMotions(impl_->world->scene, impl_->monitor, trajectories.size(), motionOf, request);
  std::vector<MotionSummary> summaries;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const MotionVerdict& found = verdicts[i];
    MotionSummary& summary = summaries.emplace_back();
    summary.verdict = found.verdict;
    summary.error_bound = found.error_bound;
    if (found.verdict == Verdict::kClear) continue;
    if (found.time >= 0.0) summary.time = trajectories[i].times.front() + found.time;
    const auto setNames = [&](const auto& pair) {
      summary.body_a = impl_->nameOf(pair.body_a);
      summary.body_b = impl_->nameOf(pair.body_b);
    };
    if (found.pair >= 0)
      setNames(impl_->scene().pairs[static_cast<std::size_t>(found.pair)]);
    else if (!found.unchecked.empty())
      setNames(found.unchecked.front());
  }
  return summaries;
}

}  // namespace sdf_ccd
