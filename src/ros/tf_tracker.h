#pragma once

#include <string>
#include <vector>

#include "ros/tf_history.h"
#include "sdf_ccd/scene/sample_motion.h"

namespace sdf_ccd {

struct TfTrackerOptions {
  double max_latency = 0.5;  ///< frames that lag behind more than this are not waited for [s]
  double max_cycle = 1.0;    ///< longer cycles, and gaps between transforms, are not checked [s]
  MotionSampling sampling;
};

/// A body that tf moves.
struct TrackedBody {
  std::string frame;
  Isometry3d X_frame_B = Isometry3d::Identity();
  BoundingBall ball_B;
};

std::vector<TrackedBody> trackedBodies(const Scene& scene);

/// The motion of all bodies over one cycle (start, end], and over what was left of earlier ones.
struct TrackedCycle {
  ros::Time start;
  ros::Time end;
  ros::Time complete_until;     ///< up to here all pairs have been dealt with; `end` if none is delayed
  ros::Time origin;             ///< the motion's time 0: start, or earlier if pairs that were delayed are caught up on
  CycleMotion motion;           ///< in the fixed frame
  std::vector<double> samples;  ///< [s] from origin: the recorded transforms, and the ends of all pairs' spans
};

/// Turns recorded transforms into cycles (design §5). Every pair is checked as far as both its frames are known, from
/// where its last check ended; a cycle ends where the foremost pair does. So a frame that lags behind delays only its
/// own pairs, up to max_latency; then its bodies are CycleMotion::missing and the time is not checked. It lags behind
/// the newest transform of all or, where time is not simulated, behind the wall clock. Poses are taken at every
/// recorded transform and, between them, as tf2 interpolates.
class TfTracker {
 public:
  /// @param pairs  of bodies, by index.
  TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const std::vector<PlannedPair>& pairs,
            const TfTrackerOptions& options);

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
  struct PairTimes {
    ros::Time from, until;
  };

  void look(const ros::Time& now, std::vector<std::string>& missing);
  bool begin(bool waited_enough, const std::vector<std::string>& missing);
  ros::Time foremostEnd(const std::vector<std::string>& missing) const;
  void advancePairs(TrackedCycle& cycle);
  void findGaps(const TrackedCycle& cycle, std::vector<std::string>& missing) const;
  std::vector<double> recordedSamples(const TrackedCycle& cycle) const;
  void setSpans(TrackedCycle& cycle) const;
  bool poseAt(std::size_t body, const ros::Time& time, Isometry3d& X_WB, std::string& problem) const;

  TfHistory& history_;
  std::vector<TrackedBody> bodies_;
  std::vector<std::string> frames_;
  std::vector<BoundingBall> balls_;
  std::vector<PlannedPair> pairs_;
  TfTrackerOptions options_;
  ros::Time last_end_;            // of the last cycle; 0 before the first
  ros::Time waits_since_;         // on the ROS clock; 0 before the first step
  std::vector<PairTimes> times_;  // of the cycle, per pair; the next one goes on from `until`

  // What look() sees: per body, and the newest time of all that is not in the future.
  std::vector<TfHistory::Span> spans_;
  std::vector<ros::Time> ends_;
  ros::Time reference_;
  std::vector<ros::Time> needed_from_;  // per body, by those of its pairs that advance; the cycle's end if none does
};

}  // namespace sdf_ccd
