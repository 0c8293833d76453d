#pragma once

#include <memory>

#include "monitor/contact_tracker.h"
#include "monitor/pair_distances.h"
#include "ros/monitor/reach_guard.h"
#include "ros/parameters/parameters.h"

namespace sdf_ccd {

/// What a loop needs of another world, made ahead by MonitorLoop::prepare(); after MonitorLoop::adopt() what the loop
/// no longer needs. To be destroyed by a thread that has the time for it.
struct LoopChange {
  std::shared_ptr<const CheckedWorld> world;
  std::unique_ptr<MonitorChange> monitor;
  std::unique_ptr<TfTracker> tracker;
  std::vector<int> pairs_before;  ///< per pair: that of bodies of these names until now; -1 if it is new
  std::unique_ptr<ReachGuard> reach_guard;
  ContactTracker::Change contacts;
  std::unique_ptr<PairDistances> distances;
  TrackedCycle cycle;
};

/// From transforms to results: one cycle of the monitor after the other, whoever brings the transforms and the clock.
///
/// Transforms go to history(), from any thread; the rest belongs to one.
class MonitorLoop {
 public:
  /// @param described  the robot's; of its scene's bodies the first are those of the world.
  MonitorLoop(std::shared_ptr<const CheckedWorld> world, DescribedScene described, const MonitorParameters& parameters);

  /// Of a world that does not change.
  MonitorLoop(const std::shared_ptr<const Scene>& scene, const DescribedScene& described,
              const MonitorParameters& parameters);

  TfHistory& history() { return history_; }
  const Scene& scene() const { return monitor_.scene(); }
  const std::shared_ptr<const CheckedWorld>& world() const { return world_; }
  const std::string& fixedFrame() const { return history_.fixedFrame(); }

  /// Checks what has become known. After kCycle, cycle() and result() are those of the new cycle; kJump forgets all
  /// clearances.
  /// @param now  the ROS clock, 0 if it does not run yet.
  /// If a check fails, its cycle has been checked nowhere.
  TfTracker::Step step(const ros::Time& now, const CycleRequest& request);

  /// Makes what another world needs, beside running cycles but not while adopt() runs. Its frames are followed from now
  /// on, those of worlds before the last one no longer.
  std::unique_ptr<LoopChange> prepare(std::shared_ptr<const CheckedWorld> next);

  /// Goes on with another world, between two cycles: result() is valid again after the next one, and cycle() has but
  /// its times. Frees nothing.
  /// @param change  that prepare() made since the last adopt().
  void adopt(LoopChange& change);
  /// A warning, if the fixed frame moves in tf, as the base of a mobile robot does, and objects of the world rest in
  /// it: so they ride along. Empty else.
  std::string movingFixedFrame() const;

  /// Forgets everything but static transforms; the next cycle begins with the next moving ones.
  void reset();

  const TrackedCycle& cycle() const { return cycle_; }
  const CycleResult& result() const { return *result_; }

  /// Over all cycles, as far as they were asked for contacts (CycleRequest::contacts); else there are none. kJump and
  /// reset() end all of them.
  const ContactTracker& contacts() const { return contacts_; }

  /// Measures the pairs that may be nearer than the range [m] at the end of the last cycle, which was asked for the
  /// clearances of all pairs (CycleRequest::skipped_pairs).
  const std::vector<PairDistance>& measureDistances(double range);

  /// As measured last.
  const std::vector<PairDistance>& distances() const { return distances_->near(); }

  /// Whether of some pair that is delayed, and not measured therefore, nothing was known before (PairDistances).
  bool hasUnknownDistance() const { return distances_->hasUnknown(); }

  /// To be called where cycles are not measured: what was known of pairs that are delayed does not hold later.
  void forgetDistances() { distances_->forget(); }

 private:
  void run(const CycleRequest& request);
  void guardReach();
  void trackContacts(const CycleRequest& request);

  std::shared_ptr<const CheckedWorld> world_;
  const DescribedScene described_;
  const TfTrackerOptions tf_options_;
  TfHistory history_;
  std::unique_ptr<TfTracker> tracker_;
  Monitor monitor_;
  TrackedCycle cycle_;
  std::unique_ptr<ReachGuard> reach_guard_;
  CycleResult guarded_;  // with pairs that should not have been left out
  const CycleResult* result_ = nullptr;
  ContactTracker contacts_;
  std::unique_ptr<PairDistances> distances_;
};

}  // namespace sdf_ccd
