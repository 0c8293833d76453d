#pragma once

#include <string>
#include <vector>

#include "motion/motion_sampling.h"
#include "motion/sample_motion.h"
#include "ros/tf/tf_history.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

struct TfTrackerOptions {
  double max_latency = 0.5;  ///< frames that lag behind by more are not waited for [s]
  double max_cycle = 1.0;    ///< longer cycles, and gaps between transforms, are not checked [s]
  MotionSampling sampling;
};

/// A body carried by a frame of tf.
struct TrackedBody {
  std::string frame;
  Isometry3d X_frame_B = Isometry3d::Identity();
  BoundingBall ball_B;
};

std::vector<TrackedBody> trackedBodies(const Scene& scene);

/// Says that a body is too far from the origin to compute with.
std::string tooFar(const std::string& frame);

/// Poses X_WB of all bodies at a time, 0 for the latest of each. `missing` receives, per body, why its pose is not
/// known; bodies for which it already gives a reason are skipped.
void posesAt(const TfHistory& history, const std::vector<TrackedBody>& bodies, const ros::Time& time,
             std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing);

/// The motion of all bodies over one cycle (start, end], and over the remainders of earlier ones.
struct TrackedCycle {
  ros::Time start;
  ros::Time end;
  ros::Time complete_until;  ///< all pairs are done up to here; `end` if none is behind
  ros::Time delayed_since;   ///< earliest time from which a pair without new transforms waits; 0 if there is none
  ros::Time origin;          ///< time 0 of the motion: `start`, or earlier if delayed pairs catch up
  CycleMotion motion;        ///< in the fixed frame
  /// [s] from origin: the recorded transforms between which a body moves, and the ends of all pairs' spans.
  std::vector<double> samples;
  std::vector<double> recorded;  ///< [s] from origin: all recorded transforms, at which a discrete check would sample
  std::vector<double> gaps;      ///< per body: see TfWindow::gaps() [s]
  std::vector<WaypointSpan>
      watched;  ///< per watched pair of the tracker: its part of the motion, as CycleMotion::spans

  /// Transforms that arrived after newer ones, where cycles had already interpolated without them; one per frame. The
  /// pairs concerned are checked again in this cycle, from there on.
  std::vector<LateTransforms> late;
};

/// Divides recorded transforms into cycles (design §5). Every pair is checked from where its last check ended to where
/// both its frames are known; a cycle ends where the latest pair does. If only pairs that are behind can go on, they do
/// so in a cycle that starts at its end. The first cycle waits until all frames are known, or max_latency is over, but
/// includes what was known of each pair while it waited. So a frame that lags behind delays only its own pairs, up to
/// max_latency; then its bodies are CycleMotion::missing and the time is not checked. The lag is measured against the
/// newest transform of all frames or, unless time is simulated, against the wall clock. Poses are sampled at every
/// recorded transform and interpolated between them as by tf2.
///
/// If a frame changes otherwise than by moving (from static to moving, to another parent), its pose in between is
/// unknown: its bodies are missing for the cycle that sees the change. If transforms arrive after newer ones, the
/// frame's pairs go back to their time, unless that is more than max_cycle ago or more than four times the time of the
/// last cycles would be checked again; then its bodies are missing from that time on.
///
/// A body that moves by more than 100 m at over 1000 m/s, also as a body of its pairs sees it, has jumped: it is
/// missing for the cycle. That is measured at the bodies, not at the origins of their frames.
///
/// A cycle with more than 300,000 poses of bodies that move is not checked at all, so that no node can make a cycle
/// last forever or use up the memory. Bodies without a moving frame in their chain have one pose per cycle.
class TfTracker {
 public:
  /// @param pairs    of bodies, by index.
  /// @param watched  further pairs, over whose time the motion of both bodies is known too, in the cycles that `pairs`
  /// need.
  TfTracker(TfHistory& history, const std::vector<TrackedBody>& bodies, const std::vector<PlannedPair>& pairs,
            const TfTrackerOptions& options, const std::vector<PlannedPair>& watched = {});

  enum class Step {
    kWaiting,  ///< no new transforms yet
    kStalled,  ///< none for max_latency
    kCycle,    ///< `cycle` is set
    kJump,     ///< time has jumped, back or decades ahead: discard all state
  };

  /// @param now  the ROS clock, 0 if it does not run yet.
  /// @param cycle  pass the same object every time: its memory is reused.
  Step next(const ros::Time& now, TrackedCycle& cycle);

  /// Starts over: the first cycle begins with the next transforms.
  void reset();

  /// Continues from another tracker, between two cycles, with other bodies. Does not allocate.
  /// @param bodies  per body, its index in `other`; -1 if it is new or has changed.
  /// @param pairs   per pair, then per watched pair, the index in `other` of the pair of bodies of the same names,
  /// whose time it continues; -1 if it is new and begins at the end of the last cycle.
  void continueFrom(TfTracker& other, const std::vector<int>& bodies, const std::vector<int>& pairs);

  /// Finds the chains of all frames, before the first step.
  void warmUp() { history_.spans(chains_, spans_); }

 private:
  /// Of all moving bodies in a cycle: about 100 MB with the data computed from them.
  static constexpr std::size_t kMaxPoses = 300000;

  void readHistory(const ros::Time& now, std::vector<std::string>& missing);
  bool hasChanged(std::size_t body) const;
  void findMoving();
  void rewindNewPairs();
  void rewindLatePairs();
  bool mayRewind(double age);
  void noteFirst();
  bool begin(bool waited_enough, const std::vector<std::string>& missing);
  ros::Time latestEnd(const std::vector<std::string>& missing) const;
  bool isKnown(std::size_t pair, const std::vector<std::string>& missing) const;
  ros::Time goesUntil(std::size_t pair, bool is_known, const ros::Time& end) const;
  bool canCatchUp(const std::vector<std::string>& missing) const;
  bool canAdvanceTogether(const TrackedCycle& cycle) const;
  void storePairTimes();
  void advancePairs(TrackedCycle& cycle);
  void sampleParts(TrackedCycle& cycle);
  void findWindows(const TrackedCycle& cycle);
  void findNeeded(const TimePart& part, const TrackedCycle& cycle);
  void copyMotion(const TrackedCycle& cycle, std::vector<std::string>& missing);
  void findSampleTimes(const TimePart& part, TrackedCycle& cycle);
  void addPairTimes(const TimePart& part, const ros::Time& origin);
  void sample(const TimePart& part, TrackedCycle& cycle);
  void findJumps(CycleMotion& motion) const;
  void setMissing(const std::string& why, TrackedCycle& cycle);
  void placeStatic(CycleMotion& motion);
  void posesDuring(double time, std::vector<Isometry3d>& X_WB, std::vector<std::string>& missing);
  void boundJerks(double start, double end, std::vector<double>& jerk);
  void setSpans(TrackedCycle& cycle) const;

  TfHistory& history_;
  std::vector<TrackedBody> bodies_;
  std::vector<std::string> frames_;
  std::vector<double> distances_;   // per body: bounds its ball's distance from its frame [m]
  std::vector<PlannedPair> pairs_;  // then the watched ones
  std::size_t checked_pairs_;       // number of those before
  TfTrackerOptions options_;
  MotionSampler sampler_;
  TfChains chains_;
  std::vector<char> is_paired_, is_checked_;  // per body: in any pair, and in one that is not just watched
  ros::Time begin_;                           // of the first cycle's earliest pair
  ros::Time first_;              // before the first cycle: since when pairs could be checked; 0 if none could yet
  ros::Time last_end_;           // of the last cycle; 0 before the first
  ros::Time waits_since_;        // on the ROS clock; 0 before the first step
  std::vector<TimePart> times_;  // per pair: its part of the cycle; the next one continues at `until`
  std::vector<char> is_known_;   // per pair: both bodies are
  bool are_together_ = false;    // all pairs are known and have the times together_; times_ is then not used
  TimePart together_;

  // Set by readHistory(): per body, and the newest time of all frames that is not in the future.
  std::vector<TfSpan> spans_;
  std::vector<ros::Time> ends_;
  ros::Time reference_;

  // Since the last cycle.
  std::vector<long> versions_;         // per body: of its chain; 0 if it was not known
  std::vector<ros::Time> changed_;     // per body: end of the cycle that saw its chain change; it is not known before
  std::vector<ros::Time> added_;       // per body: end of the last cycle before it was added to the world
  std::vector<char> was_known_;        // per body: in the last cycle, or an earlier one
  std::vector<LateTransforms> late_;   // late transforms that contradict cycles
  std::vector<std::string> too_late_;  // per body: why late times cannot be checked again; empty if they can
  double rewind_budget_ = 0.0;         // time that may still be checked again [s]
  double rewound_ = 0.0;               // time that the next cycle checks again [s]

  std::vector<std::size_t> moving_, static_;  // bodies of the cycle

  // Of the cycle, or one part of it: the parts of each body's motion that its pairs need, and that motion.
  std::vector<TimePart> windows_, checked_;
  std::vector<TimePart> needed_;
  TfWindow window_;
  std::vector<std::size_t> listed_;    // bodies whose recorded times are sampled
  std::vector<ros::Time> pair_times_;  // ends of pairs' times
  std::vector<double> sample_times_;   // [s] from the origin
  std::vector<double> pose_times_;     // per body: time of its last pose
  std::vector<Isometry3d> poses_;
};

}  // namespace sdf_ccd
