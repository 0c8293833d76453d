#include "ros/monitor/robot_in_map.h"

#include <algorithm>

#include "motion/valid_pose.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {

void RobotInMap::update(const CheckedWorld& world) {
  bodies_.clear();
  lags_.clear();
  problem_.clear();
  unknown_ = without_pose_ = 0;
  for (std::size_t b = 0; b < world.bodies.size(); ++b) {
    if (world.scene().bodies[b].is_world) continue;
    const TrackedBody& body = world.bodies[b];
    const std::string frame = withoutLeadingSlash(body.frame);
    const auto attached = world.attached_since.find(world.scene().bodies[b].name);
    const bool was_elsewhere = attached != world.attached_since.end() && attached->second > stamp_;
    const auto add = [&](const Isometry3d& X_WF, const Isometry3d& X_WM, bool is_at_stamp) {
      bodies_.push_back({b, (X_WF * body.X_frame_B).inverse() * X_WM, is_at_stamp, was_elsewhere});
    };
    if (!was_elsewhere) {
      const Isometry3d *const X_WM = poseAtStamp(frame_), *const X_WF = poseAtStamp(frame);
      if (X_WM && X_WF) {
        add(*X_WF, *X_WM, true);
        continue;
      }
      ++unknown_;
    }
    Isometry3d X_WM_now, X_WF_now;
    std::string problem;
    if (history_.lookup(frame_, ros::Time(), X_WM_now, problem) &&
        history_.lookup(frame, ros::Time(), X_WF_now, problem)) {
      add(X_WF_now, X_WM_now, false);
    } else {
      ++unknown_;
      ++without_pose_;
    }
  }
}

bool RobotInMap::isAheadOfTf(double max_lag) const {
  return std::any_of(lags_.begin(), lags_.end(), [&](double lag) { return lag <= max_lag; });
}

/// Null if it is not known.
const Isometry3d* RobotInMap::poseAtStamp(const std::string& frame) {
  const auto kept = X_W_at_stamp_.find(frame);
  if (kept != X_W_at_stamp_.end()) return &kept->second;
  const TfSpan span = history_.span(frame);
  Isometry3d X_WF;
  std::string problem;
  if (stamp_.isZero() && span.problem.empty() && !span.is_static) {
    problem = "the map has no stamp";
  } else if (history_.lookup(frame, stamp_, X_WF, problem, max_gap_)) {
    if (isNearOrigin(X_WF.translation())) return &X_W_at_stamp_.emplace(frame, X_WF).first->second;
    problem = tooFar(frame);
  }
  if (span.problem.empty() && !span.is_static && span.last < stamp_) lags_.push_back(secondsBetween(span.last, stamp_));
  if (problem_.empty()) problem_ = problem;
  return nullptr;
}

}  // namespace sdf_ccd
