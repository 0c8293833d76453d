#pragma once

#include <limits>
#include <string>
#include <vector>

#include "error_summary.h"

namespace sdf_ccd::precision {

/// One way to answer, at one setting: what it costs and how wrong it is. Its texts hold no comma.
struct Measurement {
  std::string quantity;    ///< what is asked; each has a panel of the plot
  std::string unit;        ///< of the errors
  std::string system;      ///< who answers
  std::string setting;     ///< for people; empty for a system without one
  double value = kNone;    ///< the setting's number, in the study's unit
  double seconds = 0.0;    ///< per query: median over the rounds of the mean over the queries
  ErrorSummary error;      ///< of the queries that were answered
  double bound = kNone;    ///< what the system itself says its errors do not exceed
  std::size_t missed = 0;  ///< queries without an answer where there is one

  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

struct StudyResult {
  std::string study;    ///< its name
  std::string title;    ///< of the plot
  std::string setting;  ///< what Measurement::value is, with its unit
  std::string query;    ///< what the time is for
  std::vector<Measurement> rows;
};

}  // namespace sdf_ccd::precision
