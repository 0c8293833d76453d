#include "ros/monitor/cycle_snapshot.h"

namespace sdf_ccd {

void CycleSnapshot::copyFrom(const MonitorLoop& loop) {
  const CycleResult& result = loop.result();
  world_ = loop.world();
  motion_ = loop.cycle().motion;
  samples_ = loop.cycle().recorded;
  origin_ = loop.cycle().origin;
  loop.warnings().copyTo(warnings_);
  result_.verdict = result.verdict;
  result_.error_bound = result.error_bound;
  result_.error = result.error;
  result_.contact_error = result.contact_error;
  result_.checked = result.checked;
  result_.skipped = result.skipped;
  result_.postponed = result.postponed;
  result_.incomplete = result.incomplete;
  result_.not_checked = result.not_checked;
  result_.delayed = result.delayed;
  result_.run_time = result.run_time;
  result_.not_clear = result.not_clear;
  result_.pairs.resize(result.pairs.size());
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    const PairResult& pair = result.pairs[i];
    PairResult& copy = result_.pairs[i];
    if (!pair.intervals.empty() || !copy.intervals.empty()) {
      copy = pair;
      continue;
    }
    copy.body_a = pair.body_a;
    copy.body_b = pair.body_b;
    copy.verdict = pair.verdict;
    copy.reason = pair.reason;
    copy.span = pair.span;
    copy.skipped = pair.skipped;
    copy.clearance = pair.clearance;
  }
}

}  // namespace sdf_ccd
