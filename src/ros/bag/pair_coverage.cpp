#include "ros/bag/pair_coverage.h"

#include <algorithm>

namespace sdf_ccd {

void PairCoverage::add(const TrackedCycle& cycle, const CycleResult& result, std::size_t pairs) {
  const double seconds = (cycle.end - (cycle.start == end_ ? cycle.start : cycle.origin)).toSec();
  total_ += seconds;
  end_ = cycle.end;
  pairs_.resize(pairs);
  for (std::size_t p = 0; p < pairs; ++p) {
    const PairResult& pair = result.pairs[p];
    if (pair.verdict == Verdict::kNotChecked) continue;
    pairs_[p].was_checked = true;
    pairs_[p].seconds += cycle.motion.times[pair.span.last] - cycle.motion.times[pair.span.first];
  }
  for (std::size_t p = pairs; p < result.pairs.size(); ++p) {
    doubtful_[{result.pairs[p].body_a, result.pairs[p].body_b}] += seconds;
  }
}

std::vector<PairCoverage::Doubtful> PairCoverage::doubtful(double tolerated) const {
  std::vector<Doubtful> longer;
  for (const auto& [bodies, seconds] : doubtful_)
    if (seconds > tolerated) longer.push_back({bodies.first, bodies.second, seconds});
  std::stable_sort(longer.begin(), longer.end(),
                   [](const Doubtful& a, const Doubtful& b) { return a.seconds > b.seconds; });
  return longer;
}

std::size_t PairCoverage::neverChecked() const {
  return static_cast<std::size_t>(
      std::count_if(pairs_.begin(), pairs_.end(), [](const Pair& pair) { return !pair.was_checked; }));
}

std::size_t PairCoverage::firstNeverChecked() const {
  const auto first = std::find_if(pairs_.begin(), pairs_.end(), [](const Pair& pair) { return !pair.was_checked; });
  return static_cast<std::size_t>(first - pairs_.begin());
}

PairCoverage::Partly PairCoverage::partlyChecked(double tolerated) const {
  Partly partly;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const double unchecked = total_ - pairs_[p].seconds;
    if (!pairs_[p].was_checked || !(unchecked > tolerated)) continue;
    ++partly.pairs;
    if (unchecked <= partly.unchecked) continue;
    partly.unchecked = unchecked;
    partly.worst = p;
  }
  return partly;
}

}  // namespace sdf_ccd
