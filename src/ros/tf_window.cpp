#include "ros/tf_window.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

/// The last of increasing times that is not after the given one; the first if all are.
std::size_t indexBefore(const std::vector<double>& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  return after == times.begin() ? 0 : static_cast<std::size_t>(after - times.begin()) - 1;
}

}  // namespace

void TfWindow::addRecordedTimes(std::size_t frame, std::vector<double>& times) const {
  const Frame& f = frames_[frame];
  for (const Step& step : f.way) {
    const std::vector<double>& recorded = edges_[step.edge].times;
    if (recorded.size() < 2) continue;
    const auto first = std::upper_bound(recorded.begin(), recorded.end(), f.from);
    times.insert(times.end(), first, std::lower_bound(first, recorded.end(), f.until));
  }
}

const Isometry3d& TfWindow::poseOf(Edge& edge, double time) {
  if (edge.pose_time == time) return edge.pose;
  const std::size_t i = indexBefore(edge.times, time);
  if (i + 1 == edge.times.size() || time <= edge.times[i]) {
    edge.pose = edge.poses[i].isometry();
  } else {
    edge.pose =
        interpolate(edge.poses[i], edge.poses[i + 1], (time - edge.times[i]) / (edge.times[i + 1] - edge.times[i]));
  }
  edge.pose_time = time;
  return edge.pose;
}

Isometry3d TfWindow::pose(std::size_t frame, double time) {
  Isometry3d up = Isometry3d::Identity(), down = Isometry3d::Identity();  // in the ancestor: of the frame, of the fixed
  for (const Step& step : frames_[frame].way) {
    const Isometry3d& X = poseOf(edges_[step.edge], time);
    step.up ? up = X* up : down = down * X;
  }
  return down.inverse() * up;
}

void TfWindow::addEdges(std::size_t frame, double start, double end, ChainDerivatives& motion) const {
  for (const Step& step : frames_[frame].way) {
    const Edge& edge = edges_[step.edge];
    const std::size_t i = indexBefore(edge.times, start);
    double reach = edge.poses[i].translation.norm();
    DerivativeBounds angle, slide;
    if (i + 1 < edge.times.size() && end > edge.times[i]) {
      const TfPose &a = edge.poses[i], &b = edge.poses[i + 1];
      if (start < edge.times[i] || end > edge.times[i + 1]) {
        slide.first = slide.second = slide.third = std::numeric_limits<double>::infinity();
      } else if (!isSamePlace(a, b)) {
        const double share = (end - start) / (edge.times[i + 1] - edge.times[i]);
        reach = std::max(reach, b.translation.norm());
        angle.first = share * angleBetween(a, b);
        slide.first = share * (b.translation - a.translation).norm();
      }
    }
    step.up ? motion.addFrame(reach, angle, slide) : motion.addInverse(reach, angle, slide);
  }
}

}  // namespace sdf_ccd
