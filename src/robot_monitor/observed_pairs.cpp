#include "observed_pairs.h"

#include <algorithm>
#include <memory>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "common/cancel_point.h"
#include "robot/joint_sampler.h"

namespace sdf_ccd {
namespace {

constexpr double kAnyTime = 1.0;  // duration of the resting motion [s]
constexpr double kTouch = 1e-3;   // how close surfaces are that joints hold together [m]

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

/// The default state, the recorded ones, then random ones.
class States {
 public:
  States(const RobotModel& robot, const Observation& observation)
      : observation_(observation),
        sampler_(robot, observation.seed),
        recorded_(observation.recorded ? observation.recorded->size() : 0),
        size_(1 + recorded_ + observation.random_states) {}

  bool atEnd() const { return next_ == size_; }
  std::size_t randomCount() const { return next_ > 1 + recorded_ ? next_ - 1 - recorded_ : 0; }
  double share() const { return double(next_) / double(size_); }

  /// The next states: most pairs that separate do so early, so the first are few.
  std::vector<JointPositions> nextStates() {
    constexpr std::size_t kFirst = 8, kMost = 256;
    const std::size_t count = next_ == 0 ? 1 : std::min(kMost, std::max(kFirst, 3 * next_));
    std::vector<JointPositions> states;
    for (; states.size() < count && next_ < size_; ++next_) {
      const std::size_t recorded = next_ - 1;
      states.push_back(next_ == 0             ? JointPositions()
                       : recorded < recorded_ ? observation_.recorded->state(recorded)
                                              : sampler_.next());
    }
    return states;
  }

 private:
  const Observation& observation_;
  JointSampler sampler_;
  std::size_t recorded_, size_, next_ = 0;
};

class Observer {
 public:
  Observer(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
           const Observation& observation)
      : robot_(robot), scene_(scene), pairs_(pairs), observation_(observation), observed_(pairs.size()) {
    for (const std::size_t p : pairs)
      are_neighbours_.push_back(robot.neighbours(nameOf(scene.pairs[p].body_a), nameOf(scene.pairs[p].body_b)));
  }

  std::vector<ObservedPair> observe() {
    States states(robot_, observation_);
    observeRest(states.nextStates().front());
    while (!states.atEnd()) {
      checkCancelled();
      if (observation_.progress) observation_.progress(states.share());
      std::vector<std::size_t> open;
      for (std::size_t k = 0; k < pairs_.size(); ++k)
        if (observation_.is_open(pairs_[k], observed_[k], states.randomCount())) open.push_back(k);
      if (open.empty()) break;
      observe(open, states.nextStates());
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      ObservedPair& pair = observed_[k];
      if (pair.has(Nearness::kHeld) && pair.together() == Together::kAlways) pair.hits_stop = entersDeeply(k);
    }
    return std::move(observed_);
  }

 private:
  const std::string& nameOf(int body) const { return scene_.bodies[static_cast<std::size_t>(body)].name; }

  Nearness nearnessOf(const PairResult& pair, bool are_neighbours) const {
    if (pair.verdict == Verdict::kNotChecked) return Nearness::kUnknown;
    if (pair.verdict == Verdict::kContact) return Nearness::kOverlap;
    const bool is_clear = pair.verdict == Verdict::kClear;
    // Where nothing is known of the inside, as in an open mesh, the error is larger.
    if (are_neighbours && (is_clear ? pair.clearance : pair.error.total()) <= kTouch) return Nearness::kHeld;
    if (!is_clear) return Nearness::kOpen;
    return pair.clearance <= observation_.near ? Nearness::kNear : Nearness::kApart;
  }

  std::shared_ptr<const Scene> sceneOfThese(const std::vector<std::size_t>& some) const {
    std::vector<std::size_t> pairs;
    for (const std::size_t k : some) pairs.push_back(pairs_[k]);
    return sceneOf(scene_, pairs);
  }

  void observeRest(const JointPositions& state) {
    StateTester tester(robot_, sceneOf(scene_, pairs_));
    const std::vector<PairResult>& results = tester.test(state, true);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const PairResult& result = results[k];
      observed_[k].rest_verdict = result.verdict;
      observed_[k].at_rest = nearnessOf(result, are_neighbours_[k]);
      if (result.verdict == Verdict::kContact && !result.intervals.empty())
        observed_[k].rest_depth = std::max(0.0, result.deepest.depth);
      observed_[k].add(observed_[k].at_rest, state);
    }
  }

  void observe(const std::vector<std::size_t>& some, const std::vector<JointPositions>& states) {
    const std::shared_ptr<const Scene> reduced = sceneOfThese(some);
    std::vector<Nearness> seen(some.size() * states.size());
    tbb::enumerable_thread_specific<std::unique_ptr<StateTester>> testers;
    tbb::parallel_for(std::size_t{0}, states.size(), [&](std::size_t state) {
      // A monitor's own parallel loop may start other states while it waits: these must not use the same monitor.
      tbb::this_task_arena::isolate([&] {
        std::unique_ptr<StateTester>& tester = testers.local();
        if (!tester) tester = std::make_unique<StateTester>(robot_, reduced);
        const std::vector<PairResult>& results = tester->test(states[state], false);
        for (std::size_t i = 0; i < some.size(); ++i)
          seen[state * some.size() + i] = nearnessOf(results[i], are_neighbours_[some[i]]);
      });
    });
    for (std::size_t i = 0; i < seen.size(); ++i)
      observed_[some[i % some.size()]].add(seen[i], states[i / some.size()]);
  }

  /// Whether the bodies surely enter each other by more than they may touch.
  bool entersDeeply(std::size_t k) const {
    StateTester tester(robot_, sceneOfThese({k}));
    const std::vector<JointPositions>& states = observed_[k].overlaps;
    return std::any_of(states.begin(), states.end(), [&](const JointPositions& state) {
      const PairResult& pair = tester.test(state, true).front();
      // Where parts of a body meet, the depth's error is large, as it may be deeper, but it is no less deep by more
      // than the error of a field.
      return pair.deepest.depth - std::min(pair.deepest.depth_error, pair.contact_error.total()) > kTouch;
    });
  }

  const RobotModel& robot_;
  const Scene& scene_;
  const std::vector<std::size_t>& pairs_;
  const Observation& observation_;
  std::vector<ObservedPair> observed_;
  std::vector<bool> are_neighbours_;
};

}  // namespace

void ObservedPair::add(Nearness nearness, const JointPositions& state) {
  constexpr std::size_t kMost = 20;
  ++tested;
  seen_ |= 1U << static_cast<int>(nearness);
  if (nearness == Nearness::kOverlap && overlaps.size() < kMost) overlaps.push_back(state);
}

Together ObservedPair::together() const {
  const bool is_apart = has(Nearness::kApart) || has(Nearness::kNear) || has(Nearness::kOpen);
  if (has(Nearness::kUnknown) || tested == 0) return Together::kUnknown;
  if (!is_apart && !hits_stop) return Together::kAlways;
  if (has(Nearness::kOverlap)) return Together::kSometimes;
  return has(Nearness::kNear) || has(Nearness::kOpen) || has(Nearness::kHeld) ? Together::kClose : Together::kNever;
}

std::vector<ObservedPair> observePairs(const RobotModel& robot, const Scene& scene,
                                       const std::vector<std::size_t>& pairs, const Observation& observation) {
  if (pairs.empty()) return {};
  return Observer(robot, scene, pairs, observation).observe();
}

}  // namespace sdf_ccd
