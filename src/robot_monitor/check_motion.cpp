#include "robot_monitor/check_motion.h"

#include <algorithm>
#include <stdexcept>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include "common/cancel_point.h"
#include "common/infinity.h"
#include "common/parallel_for.h"
#include "monitor/join_results.h"
#include "monitor/summarise.h"
#include "robot/planned_motion.h"
#include "robot_monitor/moved_pairs.h"

namespace sdf_ccd {
namespace {

constexpr std::size_t kWaypointsPerPiece = 16;

}  // namespace

struct MotionCheck::Impl {
  const PlannedMotion& motion;
  Monitor monitor;
  CycleRequest request;
  ResultJoiner joiner;
  CycleMotion piece;
  std::size_t done;  // index of the waypoint up to which the motion is checked
  MovedPairs moved{monitor.scene()};
};

MotionCheck::MotionCheck(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
                         const CycleRequest& request, std::shared_ptr<MonitorMemory> memory)
    : impl_(new Impl{motion,
                     Monitor(std::move(scene), options, std::move(memory)),
                     request,
                     ResultJoiner(request.max_points, request.margin),
                     {},
                     0}) {}

MotionCheck::~MotionCheck() = default;

bool MotionCheck::isDone() const {
  return impl_->done + 1 >= impl_->motion.waypoints.size();
}

const CycleMotion& MotionCheck::next() {
  const std::size_t last = std::min(impl_->done + kWaypointsPerPiece, impl_->motion.waypoints.size() - 1);
  impl_->motion.piece(impl_->done, last, impl_->piece);
  impl_->joiner.add(impl_->piece, impl_->monitor.run(impl_->piece, impl_->request));
  impl_->moved.add(impl_->piece);
  impl_->done = last;
  return impl_->piece;
}

CycleResult MotionCheck::result() const {
  CycleResult result = impl_->joiner.result();
  addUnchecked(impl_->moved.unchecked(), result);
  return result;
}

const CycleMotion& MotionCheck::ends() const {
  return impl_->joiner.motion();
}

CycleResult checkMotion(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const PlannedMotion& motion,
                        const CycleRequest& request) {
  MotionCheck check(std::move(scene), options, motion, request);
  while (!check.isDone()) check.next();
  return check.result();
}

namespace {

/// Checks pieces of motions, reusing the memory of checks from one to the next.
class MotionChecker {
 public:
  MotionChecker(std::shared_ptr<const Scene> scene, const MonitorOptions& options, const MotionsRequest& wanted)
      : monitor_(std::move(scene), options), moved_(monitor_.scene()), wanted_(wanted) {
    request_.wrenches = false;
    request_.contacts = false;
    request_.skipped_pairs = false;
    request_.margin = wanted.margin;
    request_.times = wanted.times;
  }

  /// Without MotionVerdict::pairs.
  MotionVerdict look(const PlannedMotion& motion) {
    const bool first_only = wanted_.first_only || wanted_.list_pairs;
    MotionVerdict found = begin(motion);
    forPieces(motion, request_, [&](double start, const CycleResult& result) {
      const Verdict before = found.verdict;
      add(result, found);
      if (found.verdict != before) found.time = start;
      if (found.verdict != before && found.verdict == result.verdict) findPair(start, result, found);
      return !first_only || found.verdict == Verdict::kClear;
    });
    return found;
  }

  /// With them.
  MotionVerdict list(const PlannedMotion& motion) {
    CycleRequest request = request_;
    request.contacts = true;
    MotionVerdict found = begin(motion);
    std::vector<Touch> touches(monitor_.scene().pairs.size());
    forPieces(motion, request, [&](double start, const CycleResult& result) {
      add(result, found);
      for (std::size_t i = 0; i < touches.size(); ++i) touches[i].add(start, result.pairs[i]);
      return true;
    });
    if (!found.unchecked.empty()) found.time = motion.waypoints.front();
    for (const UncheckedPair& pair : found.unchecked)
      found.pairs.push_back({pair.body_a, pair.body_b, Verdict::kNotChecked, motion.waypoints.front()});
    double earliest = kInfinity;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const Touch& touch = touches[i];
      if (touch.verdict == Verdict::kClear) continue;
      const PlannedPair& pair = monitor_.scene().pairs[i];
      found.pairs.push_back({pair.body_a, pair.body_b, touch.verdict, touch.time()});
      if (touch.verdict != found.verdict || !(touch.time() < earliest)) continue;
      found.pair = static_cast<int>(i);
      found.time = earliest = touch.time();
    }
    std::stable_sort(found.pairs.begin(), found.pairs.end(),
                     [](const MotionPairVerdict& a, const MotionPairVerdict& b) { return a.time < b.time; });
    return found;
  }

 private:
  /// Of one pair, over all pieces [s] from the motion's start.
  struct Touch {
    Verdict verdict = Verdict::kClear;
    double first_contact = kInfinity, not_clear = kInfinity;

    void add(double start, const PairResult& pair) {
      if (pair.verdict == Verdict::kClear) return;
      verdict = worseOf(verdict, pair.verdict);
      not_clear = std::min(not_clear, start);
      if (!pair.intervals.empty()) first_contact = std::min(first_contact, start + pair.intervals.front().enter);
    }
    double time() const { return first_contact < kInfinity ? first_contact : not_clear; }
  };

  MotionVerdict begin(const PlannedMotion& motion) {
    if (motion.waypoints.size() < 2) throw std::invalid_argument("check motions: a motion of less than two waypoints");
    monitor_.reset();  // so that results do not depend on the previous motion
    MotionVerdict found;
    found.verdict = monitor_.scene().pairs.empty() ? Verdict::kNotChecked : Verdict::kClear;
    moved_.begin();
    return found;
  }

  /// Calls use(start of the piece [s], result) for all pieces, until it returns false.
  template <class Use>
  void forPieces(const PlannedMotion& motion, const CycleRequest& request, const Use& use) {
    const std::size_t end = motion.waypoints.size() - 1;
    for (std::size_t first = 0; first < end;) {
      const std::size_t last = std::min(first + kWaypointsPerPiece, end);
      motion.piece(first, last, piece_);
      const CycleResult& result = monitor_.run(piece_, request);
      moved_.add(piece_);
      if (!use(motion.waypoints[first], result)) return;
      first = last;
    }
  }

  void add(const CycleResult& result, MotionVerdict& found) const {
    found.error_bound = std::max(found.error_bound, result.error_bound);
    found.verdict = worseOf(found.verdict, result.verdict);
    if (!moved_.any()) return;
    found.verdict = worseOf(found.verdict, Verdict::kNotChecked);
    found.unchecked = moved_.unchecked();
  }

  /// The pair that has the result's verdict first.
  static void findPair(double start, const CycleResult& result, MotionVerdict& found) {
    double earliest = kInfinity;
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
      const PairResult& pair = result.pairs[i];
      const double begin = pair.intervals.empty() ? 0.0 : pair.intervals.front().enter;
      if (pair.verdict != result.verdict || !(begin < earliest)) continue;
      earliest = begin;
      found.pair = static_cast<int>(i);
      found.time = start + begin;
    }
  }

  Monitor monitor_;
  MovedPairs moved_;
  const MotionsRequest& wanted_;
  CycleRequest request_;
  CycleMotion piece_;
};

}  // namespace

std::vector<MotionVerdict> checkMotions(std::shared_ptr<const Scene> scene, const MonitorOptions& options,
                                        std::size_t count,
                                        const std::function<PlannedMotion(std::size_t i, double tolerance)>& motionOf,
                                        const MotionsRequest& request) {
  if (request.tolerances.empty()) throw std::invalid_argument("check motions: no tolerances");
  std::vector<MotionVerdict> verdicts(count);
  tbb::enumerable_thread_specific<std::unique_ptr<MotionChecker>> lookers;
  parallelRanges(std::size_t{0}, count, [&](std::size_t first, std::size_t last) {
    // A monitor's own parallel loop may start other motions while it waits: these must not use the same monitor.
    tbb::this_task_arena::isolate([&] {
      std::unique_ptr<MotionChecker>& looker = lookers.local();
      if (!looker) looker = std::make_unique<MotionChecker>(scene, options, request);
      for (std::size_t i = first; i < last; ++i) {
        checkCancelled();
        for (std::size_t k = 0; k < request.tolerances.size(); ++k) {
          const bool lists = request.list_pairs && k + 1 == request.tolerances.size();
          const PlannedMotion motion = motionOf(i, request.tolerances[k]);
          verdicts[i] = lists ? looker->list(motion) : looker->look(motion);
          if (verdicts[i].verdict == Verdict::kClear) break;
        }
      }
    });
  });
  return verdicts;
}

PlannedBodies bodiesOf(const Scene& scene, const RobotModel& robot) {
  PlannedBodies planned;
  for (const Body& body : scene.bodies) {
    const int link = robot.find(body.frame);
    const bool is_known = link >= 0 || body.frame.empty();
    planned.bodies.push_back({link, body.X_frame_B, body.ball});
    planned.missing.push_back(is_known ? ""
                                       : "the robot has no link \"" + body.frame + "\", the frame of " + body.name);
  }
  return planned;
}

}  // namespace sdf_ccd
