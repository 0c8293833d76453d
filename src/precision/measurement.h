#pragma once

#include <limits>
#include <string>
#include <vector>

#include "error_summary.h"

namespace sdf_ccd::precision {

/// One method at one setting: its cost and its error. Its texts contain no comma.
struct Measurement {
  std::string quantity;    ///< the queried quantity; each has a panel of the plot
  std::string unit;        ///< of the errors
  std::string system;      ///< that answers
  std::string setting;     ///< for display; empty for a system without one
  double value = kNone;    ///< the setting's number, in the study's unit
  double seconds = 0.0;    ///< per query: median over the rounds of the mean over the queries
  ErrorSummary error;      ///< of the queries that were answered
  double bound = kNone;    ///< the system's own error bound
  std::size_t missed = 0;  ///< queries without an answer although one exists

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

struct StudyResult {
  std::string study;    ///< its name
  std::string title;    ///< of the plot
  std::string setting;  ///< name of Measurement::value, with its unit
  std::string query;    ///< the query that is timed
  std::vector<Measurement> rows;
};

}  // namespace sdf_ccd::precision
