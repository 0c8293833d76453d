#include "pair_result.h"

namespace sdf_ccd {

void clear(PairResult& result) {
  result.verdict = Verdict::kNotChecked;
  result.reason.clear();
  result.skipped = result.postponed = false;
  result.error = result.contact_error = {};
  result.clearance = -1.0;
  result.intervals.clear();
  result.deepest = {};
  result.refined = false;
  result.first_touch.reset();
  result.on_a_W = {};
  result.on_b_W = {};
  result.points.clear();
  result.peaks.clear();
}

void setSkipped(const ErrorBound& error, double clearance, PairResult& result) {
  clear(result);
  result.verdict = Verdict::kClear;
  result.skipped = true;
  result.error = error;
  result.clearance = clearance;
}

void setNotChecked(const std::string& reason, PairResult& result) {
  result.verdict = Verdict::kNotChecked;
  result.reason = reason;
}

}  // namespace sdf_ccd
