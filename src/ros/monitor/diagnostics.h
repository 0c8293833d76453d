#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>

#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// What /diagnostics tells of the monitor.
struct MonitorHealth {
  std::string failure;         ///< why the monitor cannot start; empty if it can
  std::string building;        ///< what is being built; empty if all is
  std::string stall;           ///< why no cycles run: no transforms arrive; empty if they run
  double wanted_rate = 0.0;    ///< [Hz]
  bool is_timed = false;       ///< cycles begin at that rate; else no more often
  double rate = 0.0;           ///< of cycles [Hz]
  double latency = 0.0;        ///< of the last cycle [s]
  double age = 0.0;            ///< of the oldest transforms that its pairs know [s]
  double run_time = 0.0;       ///< of the last check [s]
  ErrorBound error;            ///< of the last cycle's pair where it is largest
  double contact_error = 0.0;  ///< CycleResult::contact_error of the last cycle [m]
  double max_error = 0.0;      ///< wanted [m]; 0: none
  std::uint64_t world_version = 0;
  int pairs = 0;  ///< to be checked in each cycle
  int pairs_left_out = 0;
  std::vector<std::string> missing;     ///< "body: reason" of the last cycle
  std::vector<std::string> bad_bodies;  ///< "body: reason" of those without field or shell
  std::vector<std::string> warnings;    ///< from reading robot and world
  int pairs_delayed = 0;                ///< in the last cycle, for late transforms
  int pairs_postponed = 0;              ///< in the last cycle, as max_cycle_time was up
  long short_cycles = 0;                ///< with such pairs
  std::string moving_frame;             ///< MonitorLoop::movingFixedFrame()
  std::string awaited_frame;            ///< which frame of the trigger has never come; empty if none
  std::string contradicted;             ///< by late transforms, a short time ago; empty if nothing was
  long out_of_order = 0;                ///< transforms that came behind newer ones
  long refused = 0;                     ///< transforms that say nothing
  std::vector<std::string> bad_joints;  ///< whose positions in joint_states are not finite, and how many
  long not_kept = 0;                    ///< transforms of frames that no body needs, and there is no room for
};

/// Publishes:
///   /diagnostics  diagnostic_msgs/DiagnosticArray  once a second: cycles, transforms, bodies, and, once there are
///                                                  cycles, their rate
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name);

  /// Publishes if a second has passed, or `at_once`: as after the clock has jumped. Times of a clock that is set by more
  /// than 2^31 s throw in diagnostic_updater: then the rate is measured anew.
  void update(const MonitorHealth& health, bool at_once = false);

  /// A cycle begins, whether or not there is anything to check.
  void tick();

 private:
  void cycles(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void transforms(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void bodies(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  diagnostic_updater::Updater updater_;
  MonitorHealth health_;
  double least_rate_ = 0.0, largest_rate_ = std::numeric_limits<double>::infinity();  // [Hz]
  diagnostic_updater::FrequencyStatus rate_;
  bool ticks_ = false;
};

}  // namespace sdf_ccd
