#include "schedule.h"

#include <algorithm>

namespace sdf_ccd {

Schedule::Schedule(const Scene& scene, const MonitoredPairs& pairs)
    : scene_(scene),
      bodies_(scene),
      table_(scene, bodies_),
      is_paired_(scene.bodies.size(), 0),
      is_whole_(scene.bodies.size(), 0) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!table_.holds(static_cast<int>(i))) {
      failed_.push_back(static_cast<int>(i));
      continue;
    }
    table_.setError(static_cast<int>(i), pairs[i]->verdict.deviation());
  }
  due_.reserve(pairs.size());
  for (const PlannedPair& pair : scene.pairs)
    for (const int body : {pair.body_a, pair.body_b}) is_paired_[static_cast<std::size_t>(body)] = 1;
}

bool Schedule::isWhole(const CycleMotion& motion, std::size_t pair) const {
  const WaypointSpan span = motion.span(pair);
  return span.first == 0 && span.last + 1 == motion.times.size();
}

void Schedule::findWhole(const CycleMotion& motion) {
  const std::size_t pairs = scene_.pairs.size();
  bool all = true;
  for (std::size_t i = 0; i < pairs && !motion.spans.empty(); ++i)
    all &= isWhole(motion, i) || !table_.holds(static_cast<int>(i));
  const bool was_all = all_whole_;
  all_whole_ = all;
  if (all && was_all) return;
  std::fill(is_whole_.begin(), is_whole_.end(), 0);
  for (std::size_t i = 0; i < pairs; ++i) {
    if (!isWhole(motion, i) || !table_.holds(static_cast<int>(i))) continue;
    for (const int body : {scene_.pairs[i].body_a, scene_.pairs[i].body_b})
      is_whole_[static_cast<std::size_t>(body)] = 1;
  }
}

const std::vector<DuePair>& Schedule::findDue(const CycleMotion& motion, double margin, const MonitoredPairs& pairs) {
  findWhole(motion);
  bodies_.begin(motion, is_whole_);
  for (std::size_t i = 0; i < pairs.size() && !all_whole_; ++i) {
    if (isWhole(motion, i) || !table_.holds(static_cast<int>(i))) continue;
    handOver(motion, static_cast<int>(i), pairs[i]->verdict);
    table_.forget(static_cast<int>(i));
  }
  const std::size_t steps = motion.times.size() - 1;
  for (std::size_t k = 0; k < steps; ++k) {
    if (k > 0) bodies_.step(motion, k);
    if (k + 1 < steps) table_.advance(bodies_);
  }
  skipped_ = table_.finish(bodies_, due_, margin);
  for (const DuePair& due : due_) handOver(motion, due.pair, pairs[static_cast<std::size_t>(due.pair)]->verdict);
  return due_;
}

/// Passes on the clearance in the table, which is that at the end of the last cycle.
void Schedule::handOver(const CycleMotion& motion, int pair, PairVerdict& verdict) const {
  if (!table_.isKnown(pair)) return;
  const PlannedPair& planned = scene_.pairs[static_cast<std::size_t>(pair)];
  verdict.remember(table_.clearance(pair), bodies_.last(motion, planned.body_a), bodies_.last(motion, planned.body_b));
}

void Schedule::finish(const CycleMotion& motion, const MonitoredPairs& pairs) {
  bodies_.end(motion, is_whole_);
  for (const DuePair& due : due_) {
    const auto pair = static_cast<std::size_t>(due.pair);
    if (isWhole(motion, pair) && pairs[pair]->verdict.isKnown()) {
      table_.set(due.pair, pairs[pair]->verdict.moveClearanceOut());
    } else {
      table_.forget(due.pair);
    }
  }
}

double Schedule::motionError(int pair) const {
  const PlannedPair& planned = scene_.pairs[static_cast<std::size_t>(pair)];
  return bodies_.poseError(planned.body_a, planned.body_b);
}

void Schedule::consumeDisplacement(const Schedule& other, const SceneDifference& difference) {
  for (const int pair : difference.newPairs()) {
    if (!table_.holds(pair) || !table_.isKnown(pair)) continue;
    const PlannedPair& planned = scene_.pairs[static_cast<std::size_t>(pair)];
    double displacement = 0.0;
    for (const int body : {planned.body_a, planned.body_b}) {
      const int before = difference.bodiesBefore()[static_cast<std::size_t>(body)];
      if (before >= 0) displacement += bodies_.displacement(body, other.bodies_, before);
    }
    table_.consume(pair, displacement);
  }
}

void Schedule::adopt(const Schedule& other, const SceneDifference& difference) {
  consumeDisplacement(other, difference);
  bodies_.adopt(other.bodies_, difference.bodiesBefore());
  table_.adopt(other.table_, difference.pairsNow());
  all_whole_ = other.all_whole_;
  if (all_whole_) is_whole_.swap(is_paired_);
}

void Schedule::forget() {
  bodies_.forget();
  table_.forget();
}

}  // namespace sdf_ccd
