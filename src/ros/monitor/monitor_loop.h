#pragma once

#include <memory>

#include "robot_monitor/rigid_guard.h"
#include "robot_monitor/robot_pair_traits.h"
#include "ros/monitor/standing_warnings.h"
#include "ros/parameters/parameters.h"
#include "ros/world/checked_world.h"
#include "ros/world/describe_scene.h"
#include "sdf_ccd/distances.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// The parts of a loop for another world, made in advance by MonitorLoop::prepare(); after MonitorLoop::adopt(), the
/// loop's former parts, to be destroyed by a thread that is not time-critical.
struct LoopChange {
  std::shared_ptr<const CheckedWorld> world;
  std::unique_ptr<MonitorChange> monitor;
  std::unique_ptr<TfTracker> tracker;
  std::vector<int> pairs_before;  ///< per pair, checked or watched: see TfTracker::continueFrom()
  std::unique_ptr<RigidGuard> rigid_guard;
  std::shared_ptr<ContactTracker::Change> contacts;
  std::unique_ptr<PairDistances> distances;
  std::vector<PairTraits> traits;  ///< per pair
  std::vector<std::uint32_t> pairs_of_bodies;
  TrackedCycle cycle;
  OverlapNotes overlaps;
};

/// Runs the cycles of the monitor, from transforms to results, whatever the source of the transforms and the clock.
///
/// Any thread may add transforms to history(); the other functions belong to one thread.
class MonitorLoop {
 public:
  /// @param described  the robot and its frames; not its scene, as that of `world` is used.
  MonitorLoop(std::shared_ptr<const CheckedWorld> world, DescribedScene described, const MonitorParameters& parameters);

  /// For a world that does not change.
  MonitorLoop(const std::shared_ptr<const Scene>& scene, const DescribedScene& described,
              const MonitorParameters& parameters);

  TfHistory& history() { return history_; }
  const TfHistory& history() const { return history_; }
  const Scene& scene() const { return monitor_.scene(); }
  const std::shared_ptr<const CheckedWorld>& world() const { return world_; }
  const std::string& fixedFrame() const { return history_.fixedFrame(); }

  /// Checks the time that has become known since the last cycle. After kCycle, cycle() and result() are those of the
  /// new cycle. After kJump, all clearances are discarded.
  /// @param now  the ROS clock, 0 if it does not run yet.
  /// If a check throws, its cycle is reported as not checked.
  TfTracker::Step step(const ros::Time& now, const CycleRequest& request);

  /// Makes the parts for another world; may run in parallel to cycles, but not to adopt(). The frames of `next` and of
  /// the present world are followed from now on, those of earlier ones no longer.
  std::unique_ptr<LoopChange> prepare(std::shared_ptr<const CheckedWorld> next);

  /// Switches to another world, between two cycles. Then result() is valid only after the next cycle, and cycle() holds
  /// only its times. Frees no memory.
  /// @param change  made by prepare() since the last adopt().
  void adopt(LoopChange& change);

  /// To be called after each cycle: warns if the fixed frame moves. Looks at it every 0.2 s, and allocates memory then.
  void watchFixedFrame();

  /// Of the world that it checks, and what others add. The loop's own: which pairs overlap at rest, and whether they
  /// are set aside or checked; that the fixed frame moves in tf, like the base of a mobile robot, and objects of the
  /// world are fixed in it, so that they move with it. It is kept from then on, also while the robot rests.
  StandingWarnings& warnings() { return warnings_; }
  const StandingWarnings& warnings() const { return warnings_; }

  /// Discards everything but static transforms; the next cycle begins with the next moving ones.
  void reset();

  const TrackedCycle& cycle() const { return cycle_; }
  const CycleResult& result() const { return *result_; }

  /// What was requested of the last cycle.
  const CycleRequest& request() const { return request_; }

  /// Per body: the number of its pairs.
  const std::vector<std::uint32_t>& pairsOfBodies() const { return pairs_of_bodies_; }

  /// Per body: from when on one of its pairs was not checked in the last cycle; ros::TIME_MAX: all were.
  const std::vector<ros::Time>& uncheckedSince() const { return unchecked_since_; }

  /// The contacts over time, if cycles are requested with contacts (CycleRequest::contacts); else there are none. kJump
  /// and reset() end all of them.
  const ContactTracker& contacts() const { return contacts_; }

  /// Measures the pairs that may be closer than the range [m] at the end of the last cycle, which must have been
  /// requested with the clearances of all pairs (CycleRequest::skipped_pairs).
  const std::vector<PairDistance>& measureDistances(double range);

  /// The results of the last measurement.
  const std::vector<PairDistance>& distances() const { return distances_->near(); }

  /// Whether some pair was delayed, and so not measured, and nothing was known of its distance before (PairDistances).
  bool hasUnknownDistance() const { return distances_->hasUnknown(); }

  /// What each pair of the scene can do, and how near it may come.
  const std::vector<PairTraits>& traits() const { return traits_; }
  const DescribedScene& robot() const { return described_; }  ///< the robot and its frames

  /// To be called for cycles that are not measured, as the known distances of delayed pairs are then outdated.
  void forgetDistances() { distances_->forget(); }

 private:
  void run(const CycleRequest& request);
  void guardRigid();
  void findUnchecked();
  void trackContacts(const CycleRequest& request);
  void setOverlaps(OverlapNotes& notes);
  std::string movingFixedFrame() const;

  std::shared_ptr<const CheckedWorld> world_;
  const DescribedScene described_;
  const TfTrackerOptions tf_options_;
  TfHistory history_;
  std::unique_ptr<RigidGuard> rigid_guard_;
  std::unique_ptr<TfTracker> tracker_;
  Monitor monitor_;
  TrackedCycle cycle_;
  CycleRequest request_;
  CycleResult guarded_;  // result_ with the pairs that should not have been left out
  const CycleResult* result_ = nullptr;
  ContactTracker contacts_;
  std::unique_ptr<PairDistances> distances_;
  RobotPairTraits traits_finder_;
  std::vector<PairTraits> traits_;
  std::vector<std::uint32_t> pairs_of_bodies_;
  std::vector<ros::Time> unchecked_since_;
  StandingWarnings warnings_;
  OverlapNotes overlaps_;
  ros::Time frame_watched_;  // when the fixed frame was last tested
};

}  // namespace sdf_ccd
