#include "cycle_record.h"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "ros/messages/conversions.h"

namespace sdf_ccd::tools {

CycleRecord toRecord(const ContactArray& message) {
  const CycleStatus& cycle = message.cycle;
  if (message.verdict > numberOf(Verdict::kContact) || !std::isfinite(cycle.error_bound.total) ||
      !std::isfinite(cycle.run_time)) {
    throw std::runtime_error(fmt::format("a message about contacts is damaged: verdict {}, error bound {}, run time {}",
                                         message.verdict, cycle.error_bound.total, cycle.run_time));
  }
  CycleRecord record;
  record.start = cycle.start;
  record.end = message.header.stamp;
  record.complete_until = cycle.complete_until;
  record.contradicted_since = cycle.contradicted_since;
  record.verdict = static_cast<Verdict>(message.verdict);
  record.reason = message.reason;
  record.error_bound = cycle.error_bound.total;
  record.run_time = cycle.run_time;
  record.checked = cycle.checked;
  record.skipped = cycle.skipped;
  record.not_checked = cycle.not_checked;
  record.delayed = cycle.delayed;
  for (const PairContact& pair : message.pairs) {
    record.in_contact += pair.verdict == numberOf(Verdict::kContact);
    record.uncertain += pair.verdict == numberOf(Verdict::kUncertain);
    if (pair.intervals.empty() || pair.deepest.depth <= record.depth) continue;
    record.depth = pair.deepest.depth;
    record.body_a = pair.body_a;
    record.body_b = pair.body_b;
  }
  return record;
}

std::string timeText(const ros::Time& time) {
  return fmt::format("{}.{:09}", time.sec, time.nsec);
}

std::string cycleColumns() {
  return "t0,t1,complete_until,verdict,error_bound,run_time,checked,skipped,not_checked,delayed,contact,uncertain,"
         "depth,body_a,body_b,contradicted_since,reason\n";
}

std::string toRow(const CycleRecord& r) {
  return fmt::format("{},{},{},{},{:.6g},{:.6g},{},{},{},{},{},{},{:.6g},{},{},{},{}\n", timeText(r.start),
                     timeText(r.end), timeText(r.complete_until), toString(r.verdict), r.error_bound, r.run_time,
                     r.checked, r.skipped, r.not_checked, r.delayed, r.in_contact, r.uncertain, r.depth,
                     csvText(r.body_a), csvText(r.body_b), timeText(r.contradicted_since), csvText(r.reason));
}

std::string csvText(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace sdf_ccd::tools
