#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "monitor/cycle_safety.h"
#include "ros/tf/tf_history.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd {

/// State of the monitor, as published on /diagnostics.
struct MonitorHealth {
  std::string failure;                           ///< why the monitor cannot start; empty if it can
  std::string building;                          ///< progress of building the fields; empty when they are built
  std::string stall;                             ///< why no cycles run: no transforms arrive; empty if they run
  Health safety = Health::kError;                ///< CycleSafety::health of the last cycle
  std::string finding = "no cycle has run yet";  ///< why it is not kOk
  double wanted_rate = 0.0;                      ///< [Hz]
  bool is_timed = false;                         ///< cycles run at that rate; else at most that often
  double rate = 0.0;                             ///< of cycles [Hz]
  double latency = 0.0;                          ///< of the last cycle [s]
  double age = 0.0;                              ///< time since all pairs were last known [s]
  double run_time = 0.0;                         ///< of the last check [s]
  ErrorSources error;                            ///< of the pair of the last cycle that has the largest
  double contact_error = 0.0;                    ///< CycleResult::contact_error of the last cycle [m]
  double max_error = 0.0;                        ///< requested [m]; 0: none
  std::uint64_t world_version = 0;
  int pairs = 0;  ///< to be checked in each cycle
  int pairs_left_out = 0;
  std::vector<std::string> missing;     ///< "body: reason" of the last cycle
  std::vector<std::string> bad_bodies;  ///< "body: reason" of those without field or shell
  std::vector<std::string> warnings;    ///< from reading robot and world
  int pairs_delayed = 0;                ///< in the last cycle, because of late transforms
  int pairs_postponed = 0;              ///< in the last cycle, because of max_cycle_time
  int pairs_incomplete = 0;             ///< likewise: contacts that are only known to be some
  long short_cycles = 0;                ///< number of cycles with such pairs
  std::vector<std::string> standing;    ///< MonitorLoop::warnings()
  std::string trigger_warning;          ///< about a frame of the trigger that has never arrived; empty if there is none
  std::string contradicted;  ///< late transforms that contradicted results recently; empty if there were none
  std::vector<std::string> bad_joints;  ///< joints with positions in joint_states that are not finite
  TfIgnored ignored;
};

}  // namespace sdf_ccd
