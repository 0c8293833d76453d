#include "ros/monitor/reach_guard.h"

#include <algorithm>

#include "motion/two_body_motion.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {

ReachGuard::ReachGuard(const CheckedWorld& world, const DescribedScene& described)
    : world_(world),
      robot_(described.robot),
      watch_(world.unreachable, world.description()),
      is_checked_(world.bodies.size(), false),
      slides_(world.unreachable.size()),
      chains_({}) {
  std::vector<std::string> frames;
  for (std::size_t p = 0; p < slides_.size(); ++p) {
    for (const SlideRange& slide : world.unreachable[p].slides) {
      const auto known =
          std::find_if(joints_.begin(), joints_.end(), [&](const Joint& j) { return j.slide.joint == slide.joint; });
      slides_[p].push_back(static_cast<std::size_t>(known - joints_.begin()));
      if (known != joints_.end()) continue;
      const urdf::Joint* joint = robot_->urdf().getJoint(slide.joint).get();
      joints_.push_back({slide, joint, {}, ""});
      for (const std::string& link : {joint->parent_link_name, joint->child_link_name})
        frames.push_back(described.frames()(link));
    }
  }
  chains_ = TfChains(frames);
  for (const PlannedPair& pair : world.scene().pairs)
    for (const int body : {pair.body_a, pair.body_b}) is_checked_[static_cast<std::size_t>(body)] = true;
}

std::vector<UncheckedPair> ReachGuard::check(const TfHistory& history, const TrackedCycle& cycle) {
  std::vector<UncheckedPair> unchecked;
  if (cycle.samples.empty() || slides_.empty()) return unchecked;
  const std::vector<char>& contradicted = watch_.contradicted(cycle.motion, cycle.watched);
  if (!joints_.empty()) copyJoints(history, cycle);
  const auto isSet = [](const std::string& text) { return !text.empty(); };
  const std::vector<std::string>& missing = cycle.motion.missing;
  bool any = std::any_of(missing.begin(), missing.end(), isSet) ||
             std::any_of(contradicted.begin(), contradicted.end(), [](char is) { return is != 0; });
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    joints_[j].problem = problem(j);
    any |= isSet(joints_[j].problem);
  }
  if (!any) return unchecked;
  for (std::size_t p = 0; p < slides_.size(); ++p) {
    const UnreachablePair& pair = world_.unreachable[p];
    std::string reason = contradicted[p] ? contradictionOf(pair) : notWatched(history, cycle, p);
    for (const std::size_t joint : slides_[p])
      if (reason.empty()) reason = joints_[joint].problem;
    if (!reason.empty()) unchecked.push_back({pair.body_a, pair.body_b, reason});
  }
  return unchecked;
}

/// Why a pair was not watched, of which nothing else tells it: a body that is also in checked pairs is named there. Of
/// a body that tf does not know, nothing contradicts the URDF.
std::string ReachGuard::notWatched(const TfHistory& history, const TrackedCycle& cycle, std::size_t pair) const {
  const WaypointSpan& span = cycle.watched[pair];
  const std::vector<std::string>& missing = cycle.motion.missing;
  if (span.empty() || missing.empty()) return {};
  for (const int of : {world_.unreachable[pair].body_a, world_.unreachable[pair].body_b}) {
    const auto body = static_cast<std::size_t>(of);
    if (missing[body].empty()) continue;
    if (is_checked_[body]) return {};
    const TfSpan known = history.span(withoutLeadingSlash(world_.bodies[body].frame));
    if (!known.problem.empty() || known.first > cycle.origin + ros::Duration(cycle.motion.times[span.first])) return {};
    return missing[body];
  }
  return {};
}

/// Copies the motion of the joints over the time that has become known since the last cycle.
void ReachGuard::copyJoints(const TfHistory& history, const TrackedCycle& cycle) {
  history.spans(chains_, spans_);
  parts_.clear();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const TfSpan& span = spans_[2 * j + 1];  // both frames are needed at the times at which the child is known
    const auto known = [&](const ros::Time& time) {
      if (span.is_static || !span.problem.empty()) return span.first;
      return std::min(std::max(time, span.first), span.last);
    };
    ros::Time& until = joints_[j].until;
    const ros::Time from = known(until.isZero() || until > cycle.end ? cycle.start : until);
    until = known(cycle.end);
    parts_.insert(parts_.end(), 2, {std::min(from, until), until});
  }
  history.copy(chains_, parts_, cycle.origin, window_);
}

std::string ReachGuard::problem(std::size_t index) {
  const Joint& joint = joints_[index];
  const std::size_t parent = 2 * index, child = parent + 1;
  for (const std::size_t frame : {child, parent}) {
    if (window_.problem(frame).empty()) continue;
    return std::string(kOutOfReach) + " because of joint " + joint.slide.joint +
           ", whose position is not known: " + window_.problem(frame);
  }
  const TimePart& part = parts_[child];
  times_ = {secondsBetween(window_.origin(), part.from), secondsBetween(window_.origin(), part.until)};
  frames_ = {parent, child};
  if (part.from < part.until) window_.addRecordedTimes(frames_, times_, recorded_);
  recorded_.clear();
  for (const double time : times_) {
    const Isometry3d X_PC = relativePose(window_.pose(parent, time), window_.pose(child, time));
    const std::string beyond = beyondReach(joint.slide, robot_->positionAt(*joint.joint, X_PC));
    if (!beyond.empty()) return beyond;
  }
  return {};
}

}  // namespace sdf_ccd
