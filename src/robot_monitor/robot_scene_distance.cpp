// Distances of a RobotScene's bodies where the joints are, by name.

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "common/infinity.h"
#include "common/number_text.h"
#include "robot/planned_motion.h"
#include "robot_monitor/robot_scene_impl.h"
#include "scene/name_pair.h"
#include "sdf_ccd/distances.h"

namespace sdf_ccd {
namespace {

constexpr double kSmallestRange = 1e-3;                 // of a search for the smallest distance [m]
constexpr double kLargestRange = 10.0 * kFarthestPose;  // no two bodies with known poses are farther apart [m]

bool isNearer(const BodyDistance& a, const BodyDistance& b) {
  return std::pair(a.distance, -a.depth) < std::pair(b.distance, -b.depth);
}

bool isUncertain(const PairResult& pair) {
  return pair.verdict == Verdict::kUncertain;
}

}  // namespace

/// The scene's bodies at rest in one state.
class RobotScene::Impl::StateDistances {
 public:
  explicit StateDistances(const Impl& scene)
      : scene_(scene), monitor_(scene.world->scene, scene.monitor, scene.memory), distances_(scene.world->scene) {}

  /// What follows is about this state.
  void measure(const RobotState& state) {
    monitor_.reset();  // so that results do not depend on the previous state
    distances_.forget();
    const PlannedMotion rest = scene_.planned({{0.0, 1.0}, {state, state}}, true, scene_.sampling);
    rest.piece(0, rest.waypoints.size() - 1, motion_);
    CycleRequest request;
    request.wrenches = false;
    result_ = &monitor_.run(motion_, request);
  }

  const CycleResult& result() const { return *result_; }

  /// All pairs that may be within the range. What may be inside another body's opening is uncertain however far apart
  /// the surfaces are.
  std::vector<BodyDistance> within(double range) {
    const bool all = std::any_of(result_->pairs.begin(), result_->pairs.end(), isUncertain);
    std::vector<BodyDistance> found;
    for (const PairDistance& pair :
         distances_.update(motion_, *result_, all ? kLargestRange : std::min(range, kLargestRange), {}))
      if (pair.distance - pair.error <= range) found.push_back(measured(pair));
    return found;
  }

  BodyDistance notChecked(const PairResult& pair) const {
    BodyDistance unknown = named(pair);
    unknown.reason = pair.reason;
    return unknown;
  }

  /// The nearest pair of those with the worst verdict, or the deepest contact; without names if no pair is checked.
  BodyDistance nearest() {
    const double clearance = smallestClearance();
    if (clearance == kInfinity) return {};
    std::vector<BodyDistance> near;
    for (double range = std::max(kSmallestRange, 2.0 * clearance); near.empty(); range *= 4.0) {
      near = within(range);
      if (range > kLargestRange) break;
    }
    const auto first = std::min_element(near.begin(), near.end(), [](const BodyDistance& a, const BodyDistance& b) {
      return a.verdict == b.verdict ? isNearer(a, b) : isWorse(a.verdict, b.verdict);
    });
    return first == near.end() ? BodyDistance() : *first;
  }

 private:
  /// The smallest lower bound of the distances [m]; negative where bodies may touch, or it is not known.
  double smallestClearance() const {
    double smallest = kInfinity;
    for (const PairResult& pair : result_->pairs)
      if (pair.verdict != Verdict::kNotChecked)
        smallest = std::min(smallest, pair.verdict == Verdict::kClear ? pair.clearance : -1.0);
    return smallest;
  }

  BodyDistance named(const PairResult& pair) const {
    BodyDistance of;
    of.body_a = scene_.nameOf(pair.body_a);
    of.body_b = scene_.nameOf(pair.body_b);
    of.verdict = pair.verdict;
    return of;
  }

  BodyDistance measured(const PairDistance& pair) const {
    const PairResult& result = result_->pairs[static_cast<std::size_t>(pair.pair)];
    BodyDistance found = named(result);
    found.distance = pair.distance;
    found.error = pair.error;
    found.point_a = pair.p_A_W;
    found.point_b = pair.p_B_W;
    found.normal = pair.normal_W;
    if (result.verdict != Verdict::kContact || result.intervals.empty()) return found;
    found.depth = result.deepest.depth;
    found.depth_error = result.deepest.depth_error;
    return found;
  }

  const Impl& scene_;
  Monitor monitor_;
  PairDistances distances_;
  CycleMotion motion_;
  const CycleResult* result_ = nullptr;
};

/// Calls use(distances in the state), with one of those that no thread uses: to make one costs more than to measure.
template <class Use>
auto RobotScene::Impl::measured(const RobotState& state, const Use& use) const {
  std::shared_ptr<StateDistances> distances;
  {
    const std::lock_guard<std::mutex> lock(idle_mutex);
    if (!idle.empty()) {
      distances = std::move(idle.back());
      idle.pop_back();
    }
  }
  if (!distances) distances = std::make_shared<StateDistances>(*this);
  distances->measure(state);
  auto result = use(*distances);
  const std::lock_guard<std::mutex> lock(idle_mutex);
  idle.push_back(std::move(distances));
  return result;
}

BodyDistance RobotScene::distance(const JointPositions& joints) const {
  return distance(RobotState{Isometry3d::Identity(), joints, {}});
}

BodyDistance RobotScene::distance(const RobotState& state) const {
  return impl_->measured(state, [&](Impl::StateDistances& distances) {
    BodyDistance nearest = distances.nearest();
    if (distances.result().pairs.empty()) nearest.reason = "no pairs: there is nothing to measure";
    for (const PairResult& pair : distances.result().pairs) {
      if (pair.verdict != Verdict::kNotChecked || mayTouch(nearest.verdict)) continue;
      nearest.verdict = Verdict::kNotChecked;
      nearest.reason = pairName(impl_->scene(), pair) + ": " + pair.reason;
      break;
    }
    return nearest;
  });
}

std::vector<BodyDistance> RobotScene::distances(const JointPositions& joints, double range) const {
  return distances(RobotState{Isometry3d::Identity(), joints, {}}, range);
}

std::vector<BodyDistance> RobotScene::distances(const RobotState& state, double range) const {
  if (!(range >= 0.0)) throw std::invalid_argument("a range of " + numberText(range) + " m");
  return impl_->measured(state, [&](Impl::StateDistances& distances) {
    std::vector<BodyDistance> list;
    for (const PairResult& pair : distances.result().pairs)
      if (pair.verdict == Verdict::kNotChecked) list.push_back(distances.notChecked(pair));
    std::vector<BodyDistance> near = distances.within(range);
    std::stable_sort(near.begin(), near.end(), isNearer);
    list.insert(list.end(), near.begin(), near.end());
    return list;
  });
}

}  // namespace sdf_ccd
