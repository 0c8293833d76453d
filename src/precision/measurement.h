#pragma once

#include <limits>
#include <string>
#include <vector>

#include "error_summary.h"

namespace sdf_ccd::precision {

/// A system at one setting. Its texts contain no comma, as they are written to CSV.
struct Label {
  std::string system;    ///< that is measured
  std::string setting;   ///< for display; empty for a system without settings
  double value = kNone;  ///< the setting as a number, in the study's unit
  double bound = kNone;  ///< the system's own error bound

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

/// Its cost and error.
struct Measurement : Label {
  std::string quantity;     ///< that is queried; each quantity has a panel of the plot
  std::string unit;         ///< of the errors
  double seconds = 0.0;     ///< time per query: mean over the queries, median over the rounds
  ErrorSummary error = {};  ///< over the queries with an answer
  std::size_t missed = 0;   ///< queries without an answer although one exists
};

struct StudyResult {
  std::string study;    ///< name of the study
  std::string title;    ///< of the plot
  std::string setting;  ///< name of Measurement::value, with its unit
  std::string query;    ///< the query that is timed
  std::vector<Measurement> rows;
};

}  // namespace sdf_ccd::precision
