#include "state_verdicts.h"

#include <algorithm>
#include <memory>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace sdf_ccd {
namespace {

constexpr double kAnyTime = 1.0;  // duration of the resting motion [s]

/// Tests states, one at a time.
class StateTester {
 public:
  /// @param scene  all of its pairs must be of links.
  StateTester(const RobotModel& robot, const std::shared_ptr<const Scene>& scene) : robot_(robot), monitor_(scene, {}) {
    for (const Body& body : scene->bodies) links_.push_back(robot.find(body.name));
    motion_.times = {0.0, kAnyTime};
    motion_.X_WB.assign(links_.size(), {Isometry3d::Identity(), Isometry3d::Identity()});
  }

  /// @param contacts  whether depths are needed too.
  const std::vector<PairResult>& test(const JointPositions& positions, bool contacts) {
    const std::vector<Isometry3d> X_RL = robot_.forwardKinematics(positions);
    for (std::size_t body = 0; body < links_.size(); ++body)
      if (links_[body] >= 0) motion_.X_WB[body].assign(2, X_RL[static_cast<std::size_t>(links_[body])]);
    monitor_.reset();  // so that the result of a state does not depend on the previous one
    CycleRequest request;
    request.wrenches = false;
    request.contacts = contacts;
    return monitor_.run(motion_, request).pairs;
  }

 private:
  const RobotModel& robot_;
  Monitor monitor_;
  std::vector<int> links_;  // per body
  CycleMotion motion_;
};

std::shared_ptr<const Scene> sceneOf(const Scene& scene, const std::vector<std::size_t>& pairs) {
  const auto reduced = std::make_shared<Scene>(scene);
  reduced->pairs.clear();
  for (const std::size_t pair : pairs) reduced->pairs.push_back(scene.pairs[pair]);
  return reduced;
}

}  // namespace

std::vector<PairAtRest> pairsIn(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const JointPositions& state, const Judge& judge) {
  StateTester tester(robot, sceneOf(scene, pairs));
  std::vector<PairAtRest> states;
  for (const PairResult& pair : tester.test(state, true))
    states.push_back({judge(pair), pair.intervals.empty() ? 0.0 : std::max(0.0, pair.deepest.depth)});
  return states;
}

std::vector<Verdict> verdictsOf(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const std::vector<JointPositions>& states, const Judge& judge) {
  const std::shared_ptr<const Scene> reduced = sceneOf(scene, pairs);
  std::vector<Verdict> verdicts(pairs.size() * states.size());
  tbb::enumerable_thread_specific<std::unique_ptr<StateTester>> testers;
  tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t state) {
    // A monitor's own parallel loop may start other states while it waits: these must not use the same monitor.
    tbb::this_task_arena::isolate([&] {
      std::unique_ptr<StateTester>& tester = testers.local();
      if (!tester) tester = std::make_unique<StateTester>(robot, reduced);
      Verdict* verdict = &verdicts[state * pairs.size()];
      for (const PairResult& pair : tester->test(states[state], false)) *verdict++ = judge(pair);
    });
  });
  return verdicts;
}

}  // namespace sdf_ccd
