#pragma once

#include <limits>
#include <string>
#include <vector>

#include "motion/chain_derivatives.h"
#include "ros/tf_pose.h"

namespace sdf_ccd {

/// A part of the time.
struct TimePart {
  ros::Time from, until;
};

/// How frames moved in the fixed frame during some part of the time, copied from a TfHistory: it does not change while
/// it is read, and callbacks need not wait.
class TfWindow {
 public:
  const ros::Time& origin() const { return origin_; }

  /// Why the frame's motion is not known; empty if it is.
  const std::string& problem(std::size_t frame) const { return frames_[frame].problem; }

  /// As TfHistory::Span::version when it was copied.
  long version(std::size_t frame) const { return frames_[frame].version; }

  /// Longest time between two transforms of one edge on the frame's way that overlap its part [s].
  double longestGap(std::size_t frame) const { return frames_[frame].longest_gap; }

  /// Adds the times within the frame's part at which an edge on its way has a recorded transform that differs from one
  /// of its neighbours: between all others it rests [s].
  void addRecordedTimes(std::size_t frame, std::vector<double>& times) const;

  /// Pose in the fixed frame, as tf2 interpolates it, within the frame's part.
  /// @param time  [s] from the origin, as all others.
  Isometry3d pose(std::size_t frame, double time);

  /// Adds how the edges on the frame's way move over times without a recorded one between them; of a longer time
  /// nothing is known, and the bounds are infinite.
  /// @param motion  of points of the frame.
  void addEdges(std::size_t frame, double start, double end, ChainDerivatives& motion) const;

 private:
  friend class TfHistory;

  struct Edge {  // a frame in its parent, between the first and the last of the times, else at rest
    std::vector<double> times;
    std::vector<TfPose> poses;  // resting ones between two that are the same are left out
    double pose_time = std::numeric_limits<double>::quiet_NaN();
    Isometry3d pose;  // at that time
  };
  struct Step {
    std::size_t edge;
    bool up;  // from the frame to its parent
  };
  struct Frame {
    std::string problem;
    long version = 0;
    double longest_gap = 0.0;
    double from = 0.0, until = 0.0;
    std::vector<Step> way;  // up to the common ancestor, then down to the fixed frame
  };

  const Isometry3d& poseOf(Edge& edge, double time);

  ros::Time origin_;
  std::vector<Edge> edges_;
  std::vector<Frame> frames_;
};

}  // namespace sdf_ccd
