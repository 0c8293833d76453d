#include "summarise.h"

#include <algorithm>
#include <limits>

namespace sdf_ccd {

CycleSummary::CycleSummary(CycleResult& result, std::size_t end) : result_(result), end_(end) {
  result.error_bound = result.contact_error = 0.0;
  result.error = {};
  result.not_clear.clear();
  result.checked = result.skipped = result.not_checked = result.delayed = result.postponed = result.incomplete = 0;
}

void CycleSummary::include(const ErrorSources& error) {
  if (error.total() <= result_.error_bound) return;
  result_.error = error;
  result_.error_bound = error.total();
}

void CycleSummary::add(int index) {
  const PairResult& pair = result_.pairs[static_cast<std::size_t>(index)];
  if (pair.span.empty()) {
    if (pair.span.last < end_) ++result_.delayed;
    return;
  }
  worst_.add(pair.verdict);
  if (pair.verdict != Verdict::kClear) result_.not_clear.push_back(index);
  if (pair.verdict == Verdict::kNotChecked) {
    ++result_.not_checked;
    return;
  }
  ++(pair.skipped ? result_.skipped : pair.postponed ? result_.postponed : result_.checked);
  result_.incomplete += pair.incomplete ? 1 : 0;
  include(pair.error);
  result_.contact_error = std::max(result_.contact_error, pair.contact_error.total());
}

void CycleSummary::addSkipped(int count, const ErrorSources& error) {
  if (count == 0) return;
  worst_.add(Verdict::kClear);
  result_.skipped += count;
  include(error);
}

void CycleSummary::addFailed() {
  if (result_.failed.empty()) return;
  worst_.add(Verdict::kNotChecked);
  result_.not_checked += static_cast<int>(result_.failed.size());
}

void CycleSummary::finish() {
  std::sort(result_.not_clear.begin(), result_.not_clear.end());
  if (result_.delayed > 0) worst_.add(Verdict::kNotChecked);  // delayed pairs were not checked over some of the time
  result_.verdict = worst_.value();
}

void summarise(CycleResult& result) {
  result.failed.clear();  // they are among the pairs
  CycleSummary summary(result, std::numeric_limits<std::size_t>::max());
  for (std::size_t pair = 0; pair < result.pairs.size(); ++pair) summary.add(static_cast<int>(pair));
  summary.finish();
}

void addUnchecked(const std::vector<UncheckedPair>& pairs, CycleResult& result) {
  for (const UncheckedPair& pair : pairs) {
    PairResult unchecked;
    unchecked.body_a = pair.body_a;
    unchecked.body_b = pair.body_b;
    unchecked.reason = pair.reason;
    unchecked.span = {0, 1};
    unchecked.clearance = -1.0;
    result.not_clear.push_back(static_cast<int>(result.pairs.size()));
    result.pairs.push_back(unchecked);
    ++result.not_checked;
  }
  if (!pairs.empty()) result.verdict = worseOf(result.verdict, Verdict::kNotChecked);
}

}  // namespace sdf_ccd
