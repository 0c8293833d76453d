#include "ros/monitor/reach_guard.h"

#include <algorithm>

#include "sdf_ccd/motion/two_body_motion.h"

namespace sdf_ccd {
namespace {

/// Per joint: the frames of its parent and its child.
std::vector<std::string> framesOf(const CheckedWorld& world, const DescribedScene& described,
                                  std::vector<RobotModel::Slide>& slides) {
  std::vector<std::string> frames;
  for (const UnreachablePair& pair : world.unreachable) {
    for (const RobotModel::Slide& slide : pair.slides) {
      const auto isSame = [&](const RobotModel::Slide& other) { return other.joint == slide.joint; };
      if (std::any_of(slides.begin(), slides.end(), isSame)) continue;
      slides.push_back(slide);
      const urdf::Joint& joint = *described.robot->urdf().getJoint(slide.joint);
      frames.push_back(withoutLeadingSlash(described.tf_prefix + joint.parent_link_name));
      frames.push_back(withoutLeadingSlash(described.tf_prefix + joint.child_link_name));
    }
  }
  return frames;
}

}  // namespace

ReachGuard::ReachGuard(const CheckedWorld& world, const DescribedScene& described)
    : scene_(world.scene()), robot_(described.robot), chains_({}), is_checked_(scene_.bodies.size(), false) {
  for (const PlannedPair& pair : scene_.pairs) {
    for (const int body : {pair.body_a, pair.body_b}) is_checked_[static_cast<std::size_t>(body)] = true;
  }
  std::vector<RobotModel::Slide> slides;
  chains_ = TfChains(framesOf(world, described, slides));
  for (const RobotModel::Slide& slide : slides) {
    joints_.push_back({slide, robot_->urdf().getJoint(slide.joint).get(), ""});
  }
  for (const UnreachablePair& pair : world.unreachable) {
    const auto isLink = [&](int body) { return !scene_.bodies[static_cast<std::size_t>(body)].is_world; };
    if (isLink(pair.body_a) && isLink(pair.body_b)) unreachable_.push_back(pair);
    std::vector<std::size_t> rests_on;
    for (const RobotModel::Slide& slide : pair.slides) {
      const auto joint =
          std::find_if(joints_.begin(), joints_.end(), [&](const Joint& j) { return j.slide.joint == slide.joint; });
      rests_on.push_back(static_cast<std::size_t>(joint - joints_.begin()));
    }
    if (rests_on.empty()) continue;
    pairs_.push_back({pair.body_a, pair.body_b, ""});
    rest_on_.push_back(rests_on);
  }
}

std::vector<UncheckedPair> ReachGuard::check(const TfHistory& history, const TrackedCycle& cycle) {
  std::vector<UncheckedPair> unchecked;
  if (!unreachable_.empty()) {
    findSpans(cycle.motion);
    findNear(cycle.motion, unchecked);
  }
  if (joints_.empty()) return unchecked;
  follow(history, cycle);
  bool all_hold = true;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    joints_[j].problem = problem(j, cycle);
    all_hold &= joints_[j].problem.empty();
  }
  for (std::size_t p = 0; p < pairs_.size() && !all_hold; ++p) {
    const auto isNamed = [&](const UncheckedPair& named) {
      return named.body_a == pairs_[p].body_a && named.body_b == pairs_[p].body_b;
    };
    for (const std::size_t joint : rest_on_[p]) {
      if (joints_[joint].problem.empty() || std::any_of(unchecked.begin(), unchecked.end(), isNamed)) continue;
      unchecked.push_back({pairs_[p].body_a, pairs_[p].body_b, joints_[joint].problem});
      break;
    }
  }
  return unchecked;
}

void ReachGuard::findSpans(const CycleMotion& motion) {
  known_.assign(is_checked_.size(), {});
  if (motion.spans.empty()) {
    for (std::size_t body = 0; body < known_.size(); ++body)
      if (is_checked_[body]) known_[body] = {0, motion.times.size() - 1};
    return;
  }
  for (std::size_t p = 0; p < scene_.pairs.size(); ++p) {
    const WaypointSpan span = motion.spans[p];
    if (span.empty()) continue;
    for (const int body : {scene_.pairs[p].body_a, scene_.pairs[p].body_b}) {
      WaypointSpan& known = known_[static_cast<std::size_t>(body)];
      known = known.empty() ? span : WaypointSpan{std::min(known.first, span.first), std::max(known.last, span.last)};
    }
  }
}

/// If two balls meet at a recorded time that cannot meet according to the URDF, tf is that of another robot.
void ReachGuard::findNear(const CycleMotion& motion, std::vector<UncheckedPair>& unchecked) const {
  for (const UnreachablePair& pair : unreachable_) {
    const auto a = static_cast<std::size_t>(pair.body_a), b = static_cast<std::size_t>(pair.body_b);
    if (known_[a].empty() || known_[b].empty()) continue;
    if (!motion.missing.empty() && !(motion.missing[a].empty() && motion.missing[b].empty())) continue;
    const double reach = pair.ball_a.radius + pair.ball_b.radius;
    const std::size_t last = std::min(known_[a].last, known_[b].last);
    for (std::size_t k = std::max(known_[a].first, known_[b].first); k <= last; ++k) {
      const Vector3d way = motion.pose(a, k) * pair.ball_a.center - motion.pose(b, k) * pair.ball_b.center;
      if (way.squaredNorm() > reach * reach) continue;
      unchecked.push_back(
          {pair.body_a, pair.body_b,
           std::string(kOutOfReach) + " by the URDF, but tf has them near each other: is it this robot's?"});
      break;
    }
  }
}

/// Copies the joints' motion over the cycle, as far as each child is known.
void ReachGuard::follow(const TfHistory& history, const TrackedCycle& cycle) {
  history.spans(chains_, spans_);
  parts_.clear();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const TfSpan& child = spans_[2 * j + 1];
    const auto known = [&](double sample) {
      if (child.is_static || !child.problem.empty()) return child.first;
      return std::min(std::max(cycle.origin + ros::Duration(sample), child.first), child.last);
    };
    parts_.insert(parts_.end(), 2, {known(cycle.samples.front()), known(cycle.samples.back())});
  }
  history.copy(chains_, parts_, cycle.origin, window_);
}

std::string ReachGuard::problem(std::size_t index, const TrackedCycle& cycle) {
  const Joint& joint = joints_[index];
  const std::size_t parent = 2 * index, child = parent + 1;
  for (const std::size_t frame : {child, parent}) {
    if (window_.problem(frame).empty()) continue;
    return std::string(kOutOfReach) + " by joint " + joint.slide.joint +
           ", which is not known: " + window_.problem(frame);
  }
  const double from = (parts_[child].from - cycle.origin).toSec();
  const double until = (parts_[child].until - cycle.origin).toSec();
  for (const double sample : cycle.samples) {
    const double known = std::min(std::max(sample, from), until);
    const Isometry3d X_PC = relativePose(window_.pose(parent, known), window_.pose(child, known));
    const std::string beyond = beyondReach(joint.slide, robot_->positionAt(*joint.joint, X_PC));
    if (!beyond.empty() || from == until) return beyond;
  }
  return {};
}

}  // namespace sdf_ccd
