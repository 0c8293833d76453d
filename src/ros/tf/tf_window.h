#pragma once

#include <limits>
#include <string>
#include <vector>

#include "motion/chain_derivatives.h"
#include "ros/tf/tf_edge.h"

namespace sdf_ccd {

/// A time interval.
struct TimePart {
  ros::Time from, until;
};

/// Motion of frames in the fixed frame during a part of the time, copied from a TfHistory: it does not change while it
/// is read, and callbacks need not wait.
///
/// The frames are carried by a tree of steps rooted at the fixed frame. The values computed for a step at a time are
/// kept for all frames behind it, until they are needed at another time.
class TfWindow {
 public:
  const ros::Time& origin() const { return origin_; }

  /// Why the frame's motion is not known; empty if it is.
  const std::string& problem(std::size_t frame) const { return frames_[frame].problem; }

  /// TfSpan::version at the time of the copy.
  long version(std::size_t frame) const { return frames_[frame].source.version; }

  /// Longest time between two transforms of one edge of the frame's chain that overlap its part [s].
  double longestGap(std::size_t frame) const { return frames_[frame].source.longest_gap; }

  /// Sum of these over the edges of the frame's chain; edges with equal stamps count once [s].
  double gaps(std::size_t frame) const { return frames_[frame].source.gaps; }

  /// Adds the times at which an edge in the chain of one of the frames has a recorded transform [s].
  /// @param times     those inside the frames' parts that differ from a neighbour; between the others the edge rests.
  /// @param recorded  all of them, also at the ends of the parts; those of some edges twice.
  void addRecordedTimes(const std::vector<std::size_t>& frames, std::vector<double>& times,
                        std::vector<double>& recorded);

  /// Pose in the fixed frame at a time within the frame's part, interpolated as by tf2.
  /// @param time  [s] from the origin, like all times here.
  const Isometry3d& pose(std::size_t frame, double time);

  /// Bounds the derivatives of the position in the fixed frame of points that the frame carries, while s runs from 0 to
  /// 1 over [start, end] [m]. If a recorded transform lies between them, nothing is known and the bounds are infinite.
  /// @param distance  upper bound of the points' distance from the frame's origin [m].
  DerivativeSeries derivatives(std::size_t frame, double distance, double start, double end);

 private:
  friend class TfChains;

  struct StepSource {
    const TfEdge* edge = nullptr;
    int before = -1;  // index of the step before it, nearer to the fixed frame; -1 if there is none
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
    // The frame in its parent: moving between the first and the last of the times, else at rest.
    std::vector<double> times;
    std::vector<TfPose> poses;  // without those that equal both neighbours
    std::vector<double> resting_times;

    std::size_t piece = 0;  // index of the time at which `interpolation` begins
    TfInterpolation interpolation;
    double pose_time = std::numeric_limits<double>::quiet_NaN();
    Isometry3d X_W = Isometry3d::Identity();  // of the frame that the step leads to, at pose_time
    double start = std::numeric_limits<double>::quiet_NaN(), end = 0.0;
    CarriedDerivatives carries;  // from start to end
    bool is_bounded = true;      // false: nothing is known from start to end
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
