// Part of PairChecker: pairs whose bodies do not move relative to each other.
#include "motion/screw_motion.h"
#include "motion/two_body_motion.h"
#include "pair_checker.h"
#include "pair_result.h"

namespace sdf_ccd {

/// Pose of body B in body A's frame.
Isometry3d PairChecker::poseAtRest() const {
  const Isometry3d& X_FP = relativeMotion().start();
  return relativeMotion().f() == pair_.body_a ? X_FP : X_FP.inverse();
}

RestingAnswers::Bodies PairChecker::restingBodies() const {
  return {scene_.bodies.shared(pair_.body_a), scene_.bodies.shared(pair_.body_b)};
}

/// Whether the pair is answered by what was found before.
bool PairChecker::isAnswered(const SweptBodies& bodies, double error, const CycleRequest& request, PairResult& result) {
  const auto known = resting_->find(restingBodies(), poseAtRest(), error, request, options_);
  if (!known) return false;
  forgetClearance();
  setResting(*known, bodies, error, request.max_points, result);
  return true;
}

/// Answers a pair that is not clear once for all, as if nothing moved in the world either. What is known only from the
/// motion before, as of a body in an open mesh, is left as it is.
void PairChecker::answerOnce(const SweptBodies& bodies, double error, const CycleRequest& request, PairResult& result) {
  const Isometry3d X_AB = poseAtRest();
  const BoundingBall& ball = scene_.bodies[pair_.body_b].ball;
  if (state_.X_AB_as_it_came && maxDisplacement(*state_.X_AB_as_it_came, X_AB, ball) <= RestingAnswers::kMoved) return;
  state_.X_AB_as_it_came.reset();
  try {
    const std::shared_ptr<const RestingAnswer> found = findAtRest(X_AB, error, request);
    const Verdict verdict = found->result.verdict;
    if (verdict != result.verdict && (result.verdict == Verdict::kContact || verdict == Verdict::kNotChecked)) {
      state_.X_AB_as_it_came = X_AB;
      return;
    }
    is_to_complete_ = false;
    clear(result);
    if (verdict == Verdict::kClear) {
      result.error = found->result.error;
      return setClear(found->result.clearance + found->error - RestingAnswers::kMoved, result);
    }
    resting_->keep(restingBodies(), found);
    setResting(*found, bodies, error, request.max_points, result);
  } catch (const Cancelled&) {
    // The cycle's time is used up: what test() has found stands.
  }
}

std::shared_ptr<const RestingAnswer> PairChecker::findAtRest(const Isometry3d& X_AB, double error,
                                                             const CycleRequest& request) const {
  auto answer = std::make_shared<RestingAnswer>();
  answer->X_AB = X_AB;
  answer->error = RestingAnswers::errorFor(error + RestingAnswers::kMoved);
  answer->request = request;
  answer->request.margin = answer->request.max_time = 0.0;  // the error contains the margin
  answer->request.times = nullptr;
  answer->options = options_;
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.X_WB.assign(scene_.bodies.size(), {Isometry3d::Identity()});
  motion.X_WB[static_cast<std::size_t>(pair_.body_b)].front() = X_AB;
  motion.motion_error.assign(scene_.bodies.size(), 0.0);
  motion.motion_error[static_cast<std::size_t>(relativeMotion().p())] = answer->error;
  std::vector<PairResult> results(1);
  results[0].body_a = pair_.body_a;
  results[0].body_b = pair_.body_b;
  results[0].span = {0, 1};
  SweptBodies bodies(scene_);
  bodies.take(motion, results, {{0.0F, 0}});
  PairChecker checker(scene_, pair_, body_data_, options_);
  checker.resting_ = nullptr;
  PairMemory memory;
  memory.deadline = memory_->deadline;
  checker.run(motion, bodies, answer->request, memory, results[0]);
  checker.complete(motion, bodies, answer->request, memory, results[0]);
  if (results[0].incomplete) throw Cancelled();
  answer->result = std::move(results[0]);
  return answer;
}

}  // namespace sdf_ccd
