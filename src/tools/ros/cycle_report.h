#pragma once

#include <string>

#include "cycle_statistics.h"
#include "tools/output_file.h"

namespace sdf_ccd::tools {

/// Files with a monitor's results: cycles.csv, contacts.csv and error_time.svg. Without commit() no file is left.
class CycleReport {
 public:
  /// @throws std::runtime_error if the directory cannot be written.
  explicit CycleReport(const OutputDirectory& directory);

  void add(const ContactArray& message);

  const CycleStatistics& statistics() const { return statistics_; }

  /// @param origin  from which the plot's times count.
  /// @param title   title of the plot.
  /// @return false if there is no plot: no gnuplot, or no cycle that has a bound.
  bool commit(const ros::Time& origin, const std::string& title);

 private:
  OutputFile cycles_file_, contacts_file_;
  OutputPath plot_file_;
  CycleStatistics statistics_;
};

}  // namespace sdf_ccd::tools
