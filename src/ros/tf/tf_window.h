#pragma once

#include <limits>
#include <string>
#include <vector>

#include "motion/chain_derivatives.h"
#include "ros/tf/tf_edge.h"

namespace sdf_ccd {

/// A part of the time.
struct TimePart {
  ros::Time from, until;
};

/// How frames moved in the fixed frame during some part of the time, copied from a TfHistory: it does not change while
/// it is read, and callbacks need not wait.
///
/// The frames are carried by a tree of steps whose root is the fixed frame. What is computed for a step at a time is
/// kept for all frames behind it, until it is wanted at another time.
class TfWindow {
 public:
  const ros::Time& origin() const { return origin_; }

  /// Why the frame's motion is not known; empty if it is.
  const std::string& problem(std::size_t frame) const { return frames_[frame].problem; }

  /// As TfSpan::version when it was copied.
  long version(std::size_t frame) const { return frames_[frame].source.version; }

  /// Longest time between two transforms of one edge on the frame's way that overlap its part [s].
  double longestGap(std::size_t frame) const { return frames_[frame].source.longest_gap; }

  /// The sum of these, of all transforms on the frame's way whose stamps differ [s].
  double gaps(std::size_t frame) const { return frames_[frame].source.gaps; }

  /// Adds the times at which an edge on the way of one of the frames has a recorded transform [s].
  /// @param times     those within the frames' parts that differ from one of their neighbours: between all others it rests.
  /// @param recorded  all of them, at the parts' ends too; of some edges twice.
  void addRecordedTimes(const std::vector<std::size_t>& frames, std::vector<double>& times,
                        std::vector<double>& recorded);

  /// Pose in the fixed frame, as tf2 interpolates it, within the frame's part.
  /// @param time  [s] from the origin, as all others.
  const Isometry3d& pose(std::size_t frame, double time);

  /// Bounds the derivatives of the place in the fixed frame of points that the frame carries, while s runs from 0 to 1
  /// over times without a recorded one between them [m]; over a longer time nothing is known, and they are infinite.
  /// @param distance  of the points from the frame's origin, at most [m].
  DerivativeSeries derivatives(std::size_t frame, double distance, double start, double end);

 private:
  friend class TfChains;

  struct StepSource {
    const TfEdge* edge = nullptr;
    int before = -1;  // the step before it, nearer to the fixed frame; -1 if it begins there
    bool is_inverse = false;
  };
  struct FrameSource {
    int step = -1;
    long version = 0;
    double longest_gap = 0.0;
    double gaps = 0.0;
  };
  struct Step {
    int before = -1;
    bool is_inverse = false;
    // The frame in its parent, between the first and the last of the times, else at rest.
    std::vector<double> times;
    std::vector<TfPose> poses;  // resting ones between two that are the same are left out
    std::vector<double> resting_times;

    std::size_t piece = 0;  // the times of which it interpolates between
    TfInterpolation interpolation;
    double pose_time = std::numeric_limits<double>::quiet_NaN();
    Isometry3d X_W = Isometry3d::Identity();  // of the frame that it leads to, at that time
    double start = std::numeric_limits<double>::quiet_NaN(), end = 0.0;
    CarriedDerivatives carries;  // from start to end
    bool is_bounded = true;      // or nothing is known of it
    double listed_from = 0.0, listed_until = 0.0;
  };
  struct Frame {
    FrameSource source;
    std::string problem;
    double from = 0.0, until = 0.0;
  };

  void begin(const ros::Time& origin, std::size_t steps, std::size_t frames);
  void setStep(std::size_t step, const StepSource& source, const TimePart& part);
  void setFrame(std::size_t frame, const FrameSource& source, const TimePart& part);
  void setProblem(std::size_t frame, const std::string& problem) { frames_[frame].problem = problem; }

  const Isometry3d& poseOf(Step& step, double time);
  const Step& boundsOf(Step& step, double start, double end);
  static Isometry3d edgePose(Step& step, double time);
  static const TfInterpolation& pieceOf(Step& step, std::size_t piece);

  ros::Time origin_;
  std::vector<Step> steps_;
  std::vector<Frame> frames_;
};

}  // namespace sdf_ccd
