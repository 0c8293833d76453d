#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>

#include "sdf_ccd/query/verdict.h"

namespace sdf_ccd {

/// State of the monitor, as published on /diagnostics.
struct MonitorHealth {
  std::string failure;         ///< why the monitor cannot start; empty if it can
  std::string building;        ///< progress of building the fields; empty when they are built
  std::string stall;           ///< why no cycles run: no transforms arrive; empty if they run
  double wanted_rate = 0.0;    ///< [Hz]
  bool is_timed = false;       ///< cycles run at that rate; else at most that often
  double rate = 0.0;           ///< of cycles [Hz]
  double latency = 0.0;        ///< of the last cycle [s]
  double age = 0.0;            ///< time since all pairs were last known [s]
  double run_time = 0.0;       ///< of the last check [s]
  ErrorBound error;            ///< of the pair of the last cycle that has the largest
  double contact_error = 0.0;  ///< CycleResult::contact_error of the last cycle [m]
  double max_error = 0.0;      ///< requested [m]; 0: none
  std::uint64_t world_version = 0;
  int pairs = 0;  ///< to be checked in each cycle
  int pairs_left_out = 0;
  std::vector<std::string> missing;     ///< "body: reason" of the last cycle
  std::vector<std::string> bad_bodies;  ///< "body: reason" of those without field or shell
  std::vector<std::string> warnings;    ///< from reading robot and world
  int pairs_delayed = 0;                ///< in the last cycle, because of late transforms
  int pairs_postponed = 0;              ///< in the last cycle, because of max_cycle_time
  long short_cycles = 0;                ///< number of cycles with such pairs
  std::string moving_frame;             ///< MonitorLoop::movingFixedFrame()
  std::string trigger_warning;          ///< about a frame of the trigger that has never arrived; empty if there is none
  std::string contradicted;  ///< late transforms that contradicted results recently; empty if there were none
  long out_of_order = 0;     ///< transforms that arrived after newer ones
  long refused = 0;          ///< invalid transforms
  std::vector<std::string> bad_joints;  ///< joints with positions in joint_states that are not finite
  long not_kept = 0;                    ///< transforms of frames that no body needs, ignored for lack of memory
};

/// Publishes:
///   /diagnostics  diagnostic_msgs/DiagnosticArray  once a second: cycles, transforms, bodies, and, once there are
///                                                  cycles, their rate
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name);

  /// Publishes if a second has passed, or `at_once`, for example after the clock has jumped. If the clock is set by
  /// more than 2^31 s, diagnostic_updater throws: measuring the rate then starts again.
  void update(const MonitorHealth& health, bool at_once = false);

  /// To be called at the start of each cycle, whether or not there is anything to check.
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
