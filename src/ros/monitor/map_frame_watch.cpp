#include "ros/monitor/map_frame_watch.h"

#include <algorithm>

namespace sdf_ccd {

/// The frame that a map's frame is compared with; empty: none.
std::string MapFrameWatch::reference(const std::string& frame) const {
  const std::string& fixed = history_.fixedFrame();
  if (frame == fixed) return {};
  const std::vector<std::string> above = history_.framesAbove(fixed);
  const auto found = std::find(above.begin(), above.end(), frame);
  if (found == above.end()) return fixed;
  const std::string below = found == above.begin() ? fixed : *std::prev(found);
  const auto isStatic = [&](const std::string& name) {
    const TfSpan span = history_.span(name);
    return name == fixed || (span.problem.empty() && span.is_static);
  };
  return isStatic(below) && isStatic(root_frame_) ? "" : below;
}

bool MapFrameWatch::hasMoved(const std::string& frame, const ros::Time& stamp, const std::vector<BodyInMap>& bodies,
                             double distance) {
  const std::string reference = this->reference(frame);
  if (reference != reference_ || frame != frame_) {
    X_RM_.reset();
    is_carried_ = false;
  }
  frame_ = frame;
  reference_ = reference;
  if (reference.empty()) return false;
  Isometry3d X_WM, X_WR = Isometry3d::Identity();
  std::string problem;
  if (!history_.lookup(frame, stamp, X_WM, problem) || !history_.lookup(reference, stamp, X_WR, problem)) return false;
  const Isometry3d X_RM = X_WR.inverse() * X_WM;
  if (!X_RM_) {
    X_RM_ = X_RM;
    return false;
  }
  const Isometry3d X_MM = X_RM_->inverse() * X_RM;  // from where the frame is now to where it was
  const bool has_moved = std::any_of(bodies.begin(), bodies.end(), [&](const BodyInMap& body) {
    const Vector3d p_M = body.X_BM.inverse().translation();
    return body.is_at_stamp && !((X_MM * p_M - p_M).norm() <= distance);
  });
  if (has_moved) X_RM_ = X_RM;
  const std::vector<std::string> above = history_.framesAbove(history_.fixedFrame());
  is_carried_ |= has_moved && std::find(above.begin(), above.end(), frame) == above.end();
  return has_moved;
}

}  // namespace sdf_ccd
