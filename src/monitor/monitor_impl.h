#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

#include "monitor_memory.h"
#include "motion/validate_motion.h"
#include "schedule.h"

namespace sdf_ccd {

/// The state of a monitor of one scene.
struct Monitor::Impl {
  using Clock = std::chrono::steady_clock;

  /// What is known of the bodies and pairs of a scene; null for those of which nothing is known.
  struct Known {
    std::vector<MonitoredPair::SharedBody> bodies;
    MonitoredPairs pairs;
  };

  Impl(std::shared_ptr<const Scene> of_scene, const MonitorOptions& with_options,
       std::shared_ptr<MonitorMemory> shared_memory, Known shared = {});

  /// What the monitor of the next scene shares with this one.
  Known knownOf(const Scene& next, const SceneDifference& difference) const;

  /// Touches only what is known of pairs with a span. If it throws, what it has tested is to be forgotten.
  /// @param motion  valid.
  const CycleResult& run(const CycleMotion& motion, const CycleRequest& request);
  void takeSpans(const CycleMotion& motion);
  void takeSkipped(const CycleRequest& request);
  static Clock::time_point endOf(const CycleRequest& request, Clock::time_point start);
  void checkDue(const CycleMotion& motion, const CycleRequest& request, Clock::time_point start);
  void checkInTime(const CycleMotion& motion, const CycleRequest& request, Clock::time_point until);
  bool isSmall(const std::vector<DuePair>& due) const;
  std::size_t orderQueue(const CycleMotion& motion);
  bool isMotionKnown(const CycleMotion& motion, const DuePair& due) const;
  void measureSoon(const CycleMotion& motion, Clock::time_point until);
  void check(const DuePair& due, const CycleMotion& motion, const CycleRequest& request, PairMemory& pair_memory);
  void checkUntil(Clock::time_point until, const DuePair& due, const CycleMotion& motion, const CycleRequest& request,
                  PairMemory& pair_memory);
  void summarise(std::size_t end);
  ErrorSources errorOf(int pair) const;
  PairCycle cycleOf(const CycleMotion& motion, const CycleRequest& request, PairMemory& pair_memory) const {
    return {motion, *bodies, request, options, scene->resting.get(), pair_memory};
  }
  void forget();

  std::shared_ptr<const Scene> scene;
  MonitorOptions options;
  Known known;
  std::unique_ptr<SweptBodies> bodies;
  std::unique_ptr<Schedule> schedule;
  std::shared_ptr<MonitorMemory> memory;
  MotionShape shape;
  CycleResult result;
  std::vector<char> is_failed;              // per pair: a body of it could not be built; its result never changes
  std::vector<int> last_due;                // pairs
  std::vector<DuePair> queue;               // pairs to test, those that have waited longest first
  std::vector<std::uint64_t> due_in_cycle;  // per pair: the last cycle in which it was due
  std::uint64_t cycle = 0;
  bool are_of_cycle = false;  // results of pairs that are not due hold the clearance and error of the last cycle
  std::atomic<std::size_t> last_waypoint{0};  // last index of all results' spans; 0 if they differ
};

}  // namespace sdf_ccd
