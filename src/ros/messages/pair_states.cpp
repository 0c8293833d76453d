#include "ros/messages/pair_states.h"

#include <algorithm>

#include "query/worst_verdict.h"

namespace sdf_ccd {

void PairStates::update(const CycleResult& result, const CycleContext& cycle) {
  pairs_.resize(result.pairs.size());
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    const PairResult& pair = result.pairs[i];
    PairState& state = pairs_[i];
    if (pair.span.empty()) continue;
    state.until = cycle.start + ros::Duration(cycle.motion.times[pair.span.last]);
    state.clearance = pair.verdict == Verdict::kClear ? pair.clearance : -1.0;
    const bool holds = mayTouch(state.verdict) && state.until < state.holds_until;
    if (holds && isWorse(state.verdict, pair.verdict)) continue;
    const double depth = pair.intervals.empty() ? 0.0 : pair.deepest.depth;
    state.depth = holds && pair.verdict == state.verdict ? std::max(state.depth, depth) : depth;
    state.verdict = pair.verdict;
    state.holds_until = state.until + ros::Duration(hold_);
  }
}

void PairStates::switchPairs(const std::vector<int>& before) {
  std::vector<PairState> pairs(before.size());
  for (std::size_t p = 0; p < before.size(); ++p) {
    const auto old = static_cast<std::size_t>(before[p]);
    if (before[p] >= 0 && old < pairs_.size()) pairs[p] = pairs_[old];
  }
  pairs_ = std::move(pairs);
}

void PairStates::clear() {
  pairs_.assign(pairs_.size(), {});
}

Verdict PairStates::verdict() const {
  WorstVerdict worst;
  for (const PairState& pair : pairs_) worst.add(pair.verdict);
  return worst.value();
}

std::vector<std::optional<Verdict>> PairStates::ofBodies(const Scene& scene) const {
  std::vector<std::optional<Verdict>> verdicts(scene.bodies.size());
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const Verdict verdict = i < pairs_.size() ? pairs_[i].verdict : Verdict::kNotChecked;
    for (const int body : {scene.pairs[i].body_a, scene.pairs[i].body_b}) {
      verdicts[body] = worseOf(verdicts[body].value_or(verdict), verdict);
    }
  }
  return verdicts;
}

}  // namespace sdf_ccd
