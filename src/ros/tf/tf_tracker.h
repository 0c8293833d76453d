#pragma once

#include <string>
#include <vector>

#include "ros/tf/tf_history.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/motion/sample_motion.h"

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

/// Whether a body is farther away than can be computed with, and what is said of it.
bool isTooFar(const Isometry3d& X_WB);
std::string tooFar(const std::string& frame);

/// Poses of all bodies at a time, 0 for the latest of each; `missing` says per body why its pose is not known.
void posesAt(const TfHistory& history, const std::vector<TrackedBody>& bodies, const ros::Time& time,
             std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing);

/// The motion of all bodies over one cycle (start, end], and over what was left of earlier ones.
struct TrackedCycle {
  ros::Time start;
  ros::Time end;
  ros::Time complete_until;  ///< up to here all pairs have been dealt with; `end` if none is delayed
  ros::Time delayed_since;   ///< from here on some pair waits for its transforms; 0 if none is delayed
  ros::Time origin;          ///< the motion's time 0: start, or earlier if pairs that were delayed are caught up on
  CycleMotion motion;        ///< in the fixed frame
  /// [s] from origin: the recorded transforms between which a body moves, and the ends of all pairs' spans.
  std::vector<double> samples;
  std::vector<double> recorded;  ///< [s] from origin: all recorded transforms, as a check at samples would take them
  std::vector<double> gaps;  ///< per body: see TfWindow::gaps() [s]

  /// Transforms that came behind newer ones, where cycles had used an interpolation already, one a frame. The pairs
  /// that this concerns are dealt with again in this cycle, from there on.
  std::vector<LateTransforms> late;
};

/// Turns recorded transforms into cycles (design §5). Every pair is checked as far as both its frames are known, from
/// where its last check ended; a cycle ends where the foremost pair does. So a frame that lags behind delays only its
/// own pairs, up to max_latency; then its bodies are CycleMotion::missing and the time is not checked. It lags behind
/// the newest transform of all or, where time is not simulated, behind the wall clock. Poses are taken at every
/// recorded transform and, between them, as tf2 interpolates.
///
/// A frame that changes otherwise than by moving (from static to moving, to another parent) was somewhere unknown
/// meanwhile: its bodies are missing for the cycle that sees it. Where transforms come late behind newer ones, the
/// frame's pairs go back to there, if that is not longer ago than max_cycle, and has not been for more than four times
/// the time of late; else its bodies are missing since then.
///
/// A frame that goes more than 100 m faster than 1000 m/s has jumped: its bodies are missing for the cycle.
///
/// A cycle with more transforms than some 300,000 poses of bodies is checked nowhere, so that no node can make cycles
/// last for ever, or take all memory.
class TfTracker {
 public:
  /// @param pairs  of bodies, by index.
  TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const std::vector<PlannedPair>& pairs,
            const TfTrackerOptions& options);

  enum class Step {
    kWaiting,  ///< no new transforms yet
    kStalled,  ///< none for max_latency
    kCycle,    ///< `cycle` is set
    kJump,     ///< time has jumped, back or decades ahead: forget everything
  };

  /// @param now  the ROS clock, 0 if it does not run yet.
  /// @param cycle  the same one every time: its memory is used again.
  Step next(const ros::Time& now, TrackedCycle& cycle);

  /// The next cycle begins with the next transforms.
  void reset();

  /// Goes on with other bodies where another tracker is between two cycles; without allocating.
  /// @param bodies  per body, its index there; -1 if it is new or has changed.
  /// @param pairs  per pair, that of bodies of the same names there, from whose time it goes on; -1 if it is new, and
  /// begins at the last cycle's end.
  void take(TfTracker& other, const std::vector<int>& bodies, const std::vector<int>& pairs);

  /// Finds the ways to all frames, ahead of the first step.
  void warmUp() { history_.spans(chains_, spans_); }

 private:
  void look(const ros::Time& now, std::vector<std::string>& missing);
  bool hasChanged(std::size_t body) const;
  void goBackToLate();
  bool mayGoBack(double age);
  bool begin(bool waited_enough, const std::vector<std::string>& missing);
  ros::Time foremostEnd(const std::vector<std::string>& missing) const;
  bool goTogether(const TrackedCycle& cycle) const;
  void takeApart();
  void advancePairs(TrackedCycle& cycle);
  void follow(TrackedCycle& cycle);
  void findWindows(const TrackedCycle& cycle);
  void findNeeded(const TimePart& part, const TrackedCycle& cycle);
  void copyMotion(const TrackedCycle& cycle, std::vector<std::string>& missing);
  void findSampleTimes(const TimePart& part, TrackedCycle& cycle);
  void addPairTimes(const TimePart& part, const ros::Time& origin);
  void sample(const TimePart& part, TrackedCycle& cycle);
  void findJumps(CycleMotion& motion) const;
  void setMissing(const std::string& why, TrackedCycle& cycle);
  void posesDuring(double time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing);
  void boundJerks(double start, double end, std::vector<double>& jerk);
  void setSpans(TrackedCycle& cycle) const;
  static std::string seconds(double duration);

  TfHistory& history_;
  std::vector<TrackedBody> bodies_;
  std::vector<std::string> frames_;
  std::vector<double> distances_;  // per body: of its ball from its frame's origin, at most [m]
  std::vector<PlannedPair> pairs_;
  TfTrackerOptions options_;
  std::size_t most_samples_;
  MotionSampler sampler_;
  TfChains chains_;
  std::vector<char> is_paired_;  // per body
  ros::Time begin_;              // of the first cycle
  ros::Time last_end_;           // of the last cycle; 0 before the first
  ros::Time waits_since_;        // on the ROS clock; 0 before the first step
  std::vector<TimePart> times_;  // of the cycle, per pair; the next one goes on from `until`
  std::vector<char> is_known_;   // per pair: both bodies are
  bool are_together_ = false;    // all pairs are known, and their times these, whatever times_ says
  TimePart together_;

  // What look() sees: per body, and the newest time of all that is not in the future.
  std::vector<TfSpan> spans_;
  std::vector<ros::Time> ends_;
  ros::Time reference_;

  // Since the last cycle.
  std::vector<long> versions_;         // per body, of its way; 0 if it was not known
  std::vector<ros::Time> changed_;     // per body: its way was another up to here, or farther
  std::vector<LateTransforms> late_;   // what contradicts cycles
  std::vector<std::string> too_late_;  // per body: why that cannot be checked again; empty if it can
  double time_to_go_back_ = 0.0;       // that is left to check again [s]
  double goes_back_ = 0.0;             // in the next cycle [s]

  // Of the cycle, or one part of it: what the pairs in it need of each body's motion, and that motion.
  std::vector<TimePart> windows_, checked_;
  std::vector<TimePart> needed_;
  TfWindow window_;
  std::vector<std::size_t> listed_;    // bodies whose recorded times count
  std::vector<ros::Time> pair_times_;  // ends of pairs' times
  std::vector<double> sample_times_;   // [s] from the origin
  std::vector<double> pose_times_;     // per body, of its last pose
  std::vector<Isometry3d> poses_;
};

}  // namespace sdf_ccd
