#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <ros/time.h>

#include "sdf_ccd/monitor.h"

namespace sdf_ccd {

/// Lines for the log about contacts that certainly begin and end, for those who look at nothing else. At most
/// kPerSecond a second; the next line says how many were left out.
class ContactLog {
 public:
  static constexpr int kPerSecond = 5;

  /// The lines about the last cycle. @param now  on the wall clock, as the clock of a bag may run at any speed.
  std::vector<std::string> update(const ContactTracker& contacts, const ros::WallTime& now);

 private:
  void add(const std::string& line, const ros::WallTime& now, std::vector<std::string>& lines);

  std::vector<std::uint64_t> begun_;  // the contacts that have begun and not ended
  ros::WallTime second_;              // begin of the second in which lines are counted
  int lines_ = 0, left_out_ = 0;
};

}  // namespace sdf_ccd
