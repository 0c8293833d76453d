#include "summarise.h"

#include <algorithm>

namespace sdf_ccd {

void summarise(CycleResult& result) {
  const auto advanced = [](const PairResult& pair) { return !pair.span.empty(); };
  const bool any = std::any_of(result.pairs.begin(), result.pairs.end(), advanced);
  result.verdict = any ? Verdict::kClear : Verdict::kNotChecked;
  result.error_bound = 0.0;
  result.error = {};
  result.checked = result.skipped = result.not_checked = result.delayed = 0;
  for (const PairResult& pair : result.pairs) {
    if (pair.span.empty()) {
      ++result.delayed;
      continue;
    }
    result.verdict = std::max(result.verdict, pair.verdict);
    if (pair.verdict == Verdict::kNotChecked) {
      ++result.not_checked;
      continue;
    }
    ++(pair.skipped ? result.skipped : result.checked);
    if (pair.error.total() <= result.error_bound) continue;
    result.error = pair.error;
    result.error_bound = pair.error.total();
  }
  // Of the time that delayed pairs have not been checked over nothing is known.
  if (result.delayed > 0 && result.verdict == Verdict::kClear) result.verdict = Verdict::kNotChecked;
}

void addUnchecked(const std::vector<UncheckedPair>& pairs, CycleResult& result) {
  for (const UncheckedPair& pair : pairs) {
    PairResult unchecked;
    unchecked.body_a = pair.body_a;
    unchecked.body_b = pair.body_b;
    unchecked.reason = pair.reason;
    unchecked.span = {0, 1};
    unchecked.clearance = -1.0;
    result.pairs.push_back(unchecked);
    ++result.not_checked;
  }
  if (!pairs.empty() && result.verdict == Verdict::kClear) result.verdict = Verdict::kNotChecked;
}

}  // namespace sdf_ccd
