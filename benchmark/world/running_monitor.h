#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/monitor/world.h"

namespace sdf_ccd::benchmark {

/// What a cycle said, for who wants to check it.
struct SaidOfCycle {
  std::shared_ptr<const WorldSnapshot> world;
  CycleMotion motion;
  std::vector<Verdict> verdicts;  ///< per pair
};

/// A monitor whose cycles run at a kilohertz on a thread of their own, while another one changes its world.
class RunningMonitor {
 public:
  /// Where a body is at a time [s].
  using Place = std::function<Isometry3d(const BodyDescription& body, double time)>;

  RunningMonitor(std::shared_ptr<const WorldSnapshot> world, Place place);
  ~RunningMonitor();

  /// Makes what the monitor needs of another world, and waits until a cycle has been checked with it.
  void change(const std::shared_ptr<const WorldSnapshot>& world);

  /// Of the cycles since the last call: what each took, taking a world over included [s].
  std::vector<double> takeTimes();

  /// What taking over took, of all changes since the last call [s].
  std::vector<double> takeAdoptions();

  /// What the first cycle with the last world said.
  SaidOfCycle firstCycle();

 private:
  struct Offer {
    std::shared_ptr<const WorldSnapshot> world;
    std::unique_ptr<MonitorChange> change;
    CycleMotion motion;
  };

  void run();
  CycleMotion emptyMotion(const WorldSnapshot& world) const;
  void setMotion(double from, double until);

  Place place_;
  std::shared_ptr<const WorldSnapshot> world_;
  Monitor monitor_;
  CycleMotion motion_;
  std::unique_ptr<Offer> given_;
  std::atomic<Offer*> offered_{nullptr};
  std::atomic<bool> is_checked_{false}, stop_{false};
  std::mutex mutex_;
  std::vector<double> times_, adoptions_;  // guarded by mutex_, as what follows
  SaidOfCycle first_;
  std::thread thread_;
};

}  // namespace sdf_ccd::benchmark
