#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "sdf_ccd/monitor.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::benchmark {

/// The result of a cycle, with its world and motion, so that it can be verified.
struct CycleVerdicts {
  std::shared_ptr<const WorldSnapshot> world;
  CycleMotion motion;
  std::vector<Verdict> verdicts;  ///< per pair
};

/// A monitor whose cycles run at 1 kHz on their own thread, while another thread changes its world.
class RunningMonitor {
 public:
  /// Pose of a body at a time [s].
  using Place = std::function<Isometry3d(const BodyDescription& body, double time)>;

  RunningMonitor(std::shared_ptr<const WorldSnapshot> world, Place place);
  ~RunningMonitor();

  /// Prepares the monitor's data for another world, and waits until a cycle has been checked with it.
  void change(const std::shared_ptr<const WorldSnapshot>& world);

  /// Times of the cycles since the last call, including the adoption of a world [s].
  std::vector<double> takeTimes();

  /// Times of the adoptions since the last call [s].
  std::vector<double> takeAdoptions();

  /// Times of the first cycles with another world since the last call, including its adoption [s].
  std::vector<double> takeFirstTimes();

  /// Result of the first cycle with the latest world.
  CycleVerdicts firstCycle();

 private:
  struct Offer {
    std::shared_ptr<const WorldSnapshot> world;
    std::unique_ptr<MonitorChange> change;
    CycleMotion motion;
  };

  void run();
  CycleMotion restingMotion(const WorldSnapshot& world) const;
  void setMotion(double from, double until);

  Place place_;
  std::atomic<double> time_{0.0};  // of the next cycle's start [s]
  std::shared_ptr<const WorldSnapshot> world_;
  Monitor monitor_;
  CycleMotion motion_;
  std::unique_ptr<Offer> given_;
  std::atomic<Offer*> offered_{nullptr};
  std::atomic<bool> is_checked_{false}, stop_{false};
  std::mutex mutex_;
  std::vector<double> times_, adoptions_, first_times_;  // guarded by mutex_, like first_
  CycleVerdicts first_;
  std::thread thread_;
};

}  // namespace sdf_ccd::benchmark
