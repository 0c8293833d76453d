#pragma once

#include <string>
#include <vector>

#include "ros/tf_history.h"
#include "sdf_ccd/scene/sample_motion.h"

namespace sdf_ccd {

struct TfTrackerOptions {
  double max_latency = 0.5;  ///< frames that lag behind more than this are left out [s]
  double max_cycle = 1.0;    ///< longer cycles, and gaps between transforms, are not checked [s]
  MotionSampling sampling;
};

/// A body that tf moves.
struct TrackedBody {
  std::string frame;
  Isometry3d X_frame_B = Isometry3d::Identity();
  BoundingBall ball_B;
};

/// The motion of all bodies over one cycle (start, end].
struct TrackedCycle {
  ros::Time start;
  ros::Time end;
  CycleMotion motion;           ///< in the fixed frame
  std::vector<double> samples;  ///< [s] from start: the recorded transforms, and both ends
};

/// Turns recorded transforms into cycles (design §5). A cycle ends at the newest time at which every frame is known.
/// A frame that lags behind is waited for up to max_latency; then its bodies are CycleMotion::missing and the cycle
/// goes on without it. Poses are taken at every recorded transform and, between them, as tf2 interpolates.
class TfTracker {
 public:
  TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const TfTrackerOptions& options);

  enum class Step {
    kWaiting,  ///< no new transforms yet
    kStalled,  ///< none for max_latency
    kCycle,    ///< `cycle` is set
    kJump,     ///< time has jumped back: forget everything
  };

  /// @param now  the ROS clock, 0 if it does not run yet.
  Step next(const ros::Time& now, TrackedCycle& cycle);

  /// The next cycle begins with the next transforms.
  void reset();

  /// Poses of all bodies at a time, 0 for the latest of each; `missing` says per body why its pose is not known.
  void posesAt(const ros::Time& time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing) const;

 private:
  ros::Time cycleEnd(const ros::Time& now, std::vector<std::string>& missing);
  bool allKnownAt(const ros::Time& time, const std::vector<std::string>& missing) const;
  void findGaps(const TrackedCycle& cycle, std::vector<std::string>& missing) const;
  std::vector<double> recordedSamples(const TrackedCycle& cycle) const;

  TfHistory& history_;
  std::vector<TrackedBody> bodies_;
  std::vector<BoundingBall> balls_;
  TfTrackerOptions options_;
  ros::Time last_end_;     // of the last cycle; 0 before the first
  ros::Time waits_since_;  // on the ROS clock; 0 before the first step
  std::vector<TfHistory::Span> spans_;
};

}  // namespace sdf_ccd
