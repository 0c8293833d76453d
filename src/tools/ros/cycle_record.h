#pragma once

#include <string>

#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/result.h"

namespace sdf_ccd::tools {

/// Data of one cycle, or of a gap between cycles, for tables and plots.
struct CycleRecord {
  ros::Time start, end, complete_until;
  ros::Time contradicted_since;  ///< start of the time that late transforms contradict; 0 if there is none
  Verdict verdict = Verdict::kNotChecked;
  double error_bound = 0.0;  ///< [m]
  double run_time = 0.0;     ///< [s]
  unsigned checked = 0, skipped = 0, not_checked = 0, delayed = 0;
  unsigned in_contact = 0, uncertain = 0;  ///< among the checked pairs
  double depth = 0.0;                      ///< of the deepest point [m]; 0 if there is no contact
  std::string body_a, body_b;              ///< bodies of the deepest point
  std::string reason;                      ///< why the cycle as a whole is NOT_CHECKED

  bool hasBound() const { return checked + skipped > 0; }

  /// True if this is a part of the time over which no cycle was run.
  bool isGap() const { return verdict == Verdict::kNotChecked && run_time == 0.0; }
};

CycleRecord toRecord(const ContactArray& message);

/// Seconds with nine decimals.
std::string timeText(const ros::Time& time);

/// cycles.csv: the header, and the row of a cycle.
std::string cycleColumns();
std::string toRow(const CycleRecord& record);

/// A text as a CSV field, quoted if necessary.
std::string csvText(const std::string& text);

}  // namespace sdf_ccd::tools
