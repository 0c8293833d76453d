#include "ros/reach_guard.h"

#include <algorithm>

#include "sdf_ccd/motion/two_body_motion.h"

namespace sdf_ccd {

ReachGuard::ReachGuard(const DescribedScene& described) : robot_(described.robot) {
  for (const UnreachablePair& pair : described.unreachable) {
    std::vector<std::size_t> rests_on;
    for (const RobotModel::Slide& slide : pair.slides) {
      const auto known =
          std::find_if(joints_.begin(), joints_.end(), [&](const Joint& j) { return j.slide.joint == slide.joint; });
      rests_on.push_back(known - joints_.begin());
      if (known != joints_.end()) continue;
      const urdf::Joint& joint = *robot_->urdf().getJoint(slide.joint);
      joints_.push_back(
          {slide, &joint, described.tf_prefix + joint.parent_link_name, described.tf_prefix + joint.child_link_name});
    }
    if (rests_on.empty()) continue;
    pairs_.push_back({pair.body_a, pair.body_b, ""});
    rest_on_.push_back(rests_on);
  }
}

std::vector<UncheckedPair> ReachGuard::check(const TfHistory& history, const TrackedCycle& cycle) const {
  std::vector<std::string> problems;
  for (const Joint& joint : joints_) problems.push_back(problem(joint, history, cycle));
  std::vector<UncheckedPair> unchecked;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    for (const std::size_t joint : rest_on_[p]) {
      if (problems[joint].empty()) continue;
      unchecked.push_back({pairs_[p].body_a, pairs_[p].body_b, problems[joint]});
      break;
    }
  }
  return unchecked;
}

std::string ReachGuard::problem(const Joint& joint, const TfHistory& history, const TrackedCycle& cycle) const {
  const std::string unknown = std::string(kOutOfReach) + " by joint " + joint.slide.joint + ", which is not known: ";
  const TfHistory::Span span = history.span(joint.child);
  if (!span.problem.empty()) return unknown + span.problem;
  for (const double sample : cycle.samples) {
    const ros::Time time = cycle.origin + ros::Duration(sample);
    const ros::Time known = span.is_static ? ros::Time() : std::min(std::max(time, span.first), span.last);
    Isometry3d X_WP, X_WC;
    std::string problem;
    if (!history.lookup(joint.parent, known, X_WP, problem) || !history.lookup(joint.child, known, X_WC, problem)) {
      return unknown + problem;
    }
    const std::string beyond = beyondReach(joint.slide, robot_->positionAt(*joint.joint, relativePose(X_WP, X_WC)));
    if (!beyond.empty() || span.is_static) return beyond;
  }
  return {};
}

}  // namespace sdf_ccd
