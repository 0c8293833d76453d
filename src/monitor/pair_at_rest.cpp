#include "pair_at_rest.h"

#include "motion/screw_motion.h"
#include "motion/two_body_motion.h"
#include "pair_result.h"

namespace sdf_ccd {
namespace {

/// Pose of body B in body A's frame.
Isometry3d poseAtRest(MonitoredPair& pair) {
  const RelativeMotion& motion = pair.verdict.surfaces().motion();
  return motion.fIsA() ? motion.start() : motion.start().inverse();
}

RestingAnswers::Bodies bodiesOf(const MonitoredPair& pair) {
  return {pair.a->body, pair.b->body};
}

/// Checks the two bodies alone, in a cycle in which they rest.
std::shared_ptr<const RestingAnswer> findAtRest(const PairCycle& cycle, const Isometry3d& X_AB, double error,
                                                MonitoredPair& pair) {
  auto answer = std::make_shared<RestingAnswer>();
  answer->X_AB = X_AB;
  answer->error = RestingAnswers::errorFor(error + RestingAnswers::kMoved);
  answer->request = cycle.request;
  answer->request.margin = answer->request.max_time = 0.0;  // the error contains the margin
  answer->request.times = nullptr;
  answer->options = cycle.options;
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.X_WB = {{Isometry3d::Identity()}, {X_AB}};
  const bool f_is_a = pair.verdict.surfaces().motion().fIsA();
  motion.motion_error = {f_is_a ? 0.0 : answer->error, f_is_a ? answer->error : 0.0};  // of body P
  std::vector<PairResult> results(1);
  results[0].body_a = 0;
  results[0].body_b = 1;
  results[0].span = {0, 1};
  Scene scene;
  scene.bodies.push_back(pair.a->body);
  scene.bodies.push_back(pair.b->body);
  SweptBodies bodies(scene);
  bodies.sweepDue(motion, results, {{0.0F, 0}});
  PairMemory memory;
  memory.deadline = cycle.memory.deadline;
  MonitoredPair fresh = pair;
  fresh.forget();
  const PairCycle at_rest{motion, bodies, answer->request, cycle.options, nullptr, memory};
  checkPair(at_rest, fresh, results[0]);
  completePair(at_rest, fresh, results[0]);
  if (results[0].incomplete) throw Cancelled();
  answer->result = std::move(results[0]);
  return answer;
}

}  // namespace

bool isAnsweredAtRest(const PairCycle& cycle, double error, MonitoredPair& pair, PairResult& result) {
  const auto known = cycle.resting->find(bodiesOf(pair), poseAtRest(pair), error, cycle.request, cycle.options);
  if (!known) return false;
  pair.verdict.forgetClearance();
  setResting(*known, cycle.bodies, error, cycle.request.max_points, result);
  return true;
}

void answerAtRest(const PairCycle& cycle, double error, MonitoredPair& pair, PairResult& result) {
  const Isometry3d X_AB = poseAtRest(pair);
  if (!cycle.resting->haveRested(bodiesOf(pair), X_AB)) return;
  std::optional<Isometry3d>& as_it_came = pair.X_AB_as_it_came;
  if (as_it_came && maxDisplacement(*as_it_came, X_AB, pair.b->body->ball) <= RestingAnswers::kMoved) return;
  as_it_came.reset();
  try {
    const std::shared_ptr<const RestingAnswer> found = findAtRest(cycle, X_AB, error, pair);
    const Verdict verdict = found->result.verdict;
    if (verdict != result.verdict && (result.verdict == Verdict::kContact || verdict == Verdict::kNotChecked)) {
      as_it_came = X_AB;
      return;
    }
    clear(result);
    if (verdict == Verdict::kClear) {
      result.error = found->result.error;
      pair.verdict.setClear(found->result.clearance + found->error - RestingAnswers::kMoved);
      return setClear(pair.verdict.clearance(), result);
    }
    cycle.resting->keep(bodiesOf(pair), found);
    setResting(*found, cycle.bodies, error, cycle.request.max_points, result);
  } catch (const Cancelled&) {
    // The cycle's time is used up: what was found over the motion stands.
  }
}

}  // namespace sdf_ccd
