#include "clearance_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "clearance_scan.h"

namespace sdf_ccd {
namespace {

bool isOfWorld(const Scene& scene, const PlannedPair& pair) {
  return scene.bodies[pair.body_a].is_world || scene.bodies[pair.body_b].is_world;
}

/// A pair's slots: the one whose rows its block holds, and the one in the block's group.
struct BlockedSlots {
  std::size_t one, other;
};

/// The one is the robot's body, if the other is the world's. Between two groups of the robot, the ones are in the group
/// with fewer bodies that have such pairs: there are as many blocks as ones.
std::vector<BlockedSlots> blockedSlots(const Scene& scene, const BodyTwists& bodies) {
  std::vector<BlockedSlots> pairs;
  std::map<std::pair<std::size_t, std::size_t>, std::array<std::set<std::size_t>, 2>> between;  // two groups
  for (const PlannedPair& pair : scene.pairs) {
    const auto [one, other] = std::minmax({bodies.slot(pair.body_a), bodies.slot(pair.body_b)});
    pairs.push_back({one, other});
    if (isOfWorld(scene, pair)) continue;
    auto& [ones, others] = between[{twistGroup(one), twistGroup(other)}];
    ones.insert(one);
    others.insert(other);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    auto& [one, other] = pairs[i];
    if (isOfWorld(scene, scene.pairs[i]) || twistGroup(one) == twistGroup(other)) continue;
    const auto& [ones, others] = between.at({twistGroup(one), twistGroup(other)});
    if (others.size() < ones.size()) std::swap(one, other);
  }
  return pairs;
}

float roundedDown(double x) {
  const auto rounded = static_cast<float>(x);
  return double(rounded) <= x ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

}  // namespace

ClearanceTable::ClearanceTable(const Scene& scene, const BodyTwists& bodies) {
  using Key = std::pair<std::int32_t, std::int32_t>;  // PairBlock::rows_a and group
  std::vector<std::pair<Key, std::size_t>> placed;    // per pair: its block and lane
  std::map<Key, std::size_t> known;                   // blocks
  const std::vector<BlockedSlots> blocked = blockedSlots(scene, bodies);
  for (std::size_t pair = 0; pair < blocked.size(); ++pair) {
    const auto& [one, other] = blocked[pair];
    const Key key(twistOffset(one), twistGroup(other));
    placed.emplace_back(key, other % kTwistLanes);
    if (!hasFailedBody(scene, scene.pairs[pair])) known.emplace(key, 0);
  }
  for (auto& [key, block] : known) {
    block = blocks_.size();
    blocks_.push_back({key.first, key.second});
  }
  pairs_.assign(kTwistLanes * blocks_.size(), -1);
  for (const auto& [key, lane] : placed) {
    if (hasFailedBody(scene, scene.pairs[slots_.size()])) {
      slots_.push_back(-1);
      continue;
    }
    const std::size_t slot = kTwistLanes * known.at(key) + lane;
    if (pairs_[slot] >= 0) throw std::invalid_argument("clearance table: a pair of bodies occurs twice");
    pairs_[slot] = static_cast<std::int32_t>(slots_.size());
    slots_.push_back(static_cast<std::int32_t>(slot));
  }
  clearance_.assign(pairs_.size(), kNoPair);
  consumed_.assign(pairs_.size(), 0.0F);
  slack_.assign(pairs_.size(), 0.0F);
  error_.assign(pairs_.size(), -kNoPair);
  due_next_.assign(pairs_.size(), kDueNext);
  due_blocks_.resize(blocks_.size());
  forget();
}

void ClearanceTable::setError(int pair, double error) {
  error_[slot(pair)] = static_cast<float>(error) * kUpwards;
  PairBlock& block = blocks_[blockOf(slot(pair))];
  const auto first = error_.begin() + static_cast<std::ptrdiff_t>(blockOf(slot(pair)) * kTwistLanes);
  const auto largest = std::max_element(first, first + kTwistLanes);
  block.error = *largest;
  block.worst = static_cast<std::int32_t>(largest - error_.begin());
}

/// A slot's clearance now, rounded down: while its block waits, that before is stored.
double ClearanceTable::clearanceIn(std::size_t slot) const {
  const double path = blocks_[blockOf(slot)].path;
  const double before = clearance_[slot];
  return path > 0.0 ? std::nextafter(before - path, -std::numeric_limits<double>::infinity()) : before;
}

/// Ends the waiting of a block.
void ClearanceTable::endWait(PairBlock& block) {
  block.least = kUnknownClearance;
  if (!(block.path > 0.0F)) return;
  const auto first = static_cast<std::size_t>(&block - blocks_.data()) * kTwistLanes;
  for (std::size_t slot = first; slot < first + kTwistLanes; ++slot)
    if (pairs_[slot] >= 0) clearance_[slot] = roundedDown(clearanceIn(slot));
  block.path = 0.0F;
}

/// A pair's clearance, to be changed.
float& ClearanceTable::changeable(int pair) {
  endWait(blocks_[blockOf(slot(pair))]);
  return clearance_[slot(pair)];
}

void ClearanceTable::set(int pair, double clearance) {
  constexpr double kFar = 1e6;  // [m]: farther pairs are tested earlier than necessary
  changeable(pair) = roundedDown(std::min(clearance, kFar));
  due_next_[slot(pair)] = kDueNext;
}

void ClearanceTable::pauseDueNext(int pair) {
  due_next_[slot(pair)] = kPaused;
}

void ClearanceTable::consume(int pair, double displacement) {
  float& clearance = changeable(pair);
  clearance = roundedDown(double(clearance) - displacement);
  if (!(clearance > 0.0F)) clearance = kUnknownClearance;
}

void ClearanceTable::forget(int pair) {
  changeable(pair) = kUnknownClearance;
}

void ClearanceTable::forget() {
  for (PairBlock& block : blocks_) endWait(block);
  for (const std::int32_t slot : slots_)
    if (slot >= 0) clearance_[static_cast<std::size_t>(slot)] = kUnknownClearance;
}

void ClearanceTable::adopt(const ClearanceTable& other, const std::vector<int>& pairs_now) {
  for (PairBlock& block : blocks_) endWait(block);
  for (std::size_t pair = 0; pair < pairs_now.size(); ++pair) {
    const int now = pairs_now[pair];
    if (now < 0 || !holds(now)) continue;
    clearance_[slot(now)] = roundedDown(other.clearanceIn(other.slot(static_cast<int>(pair))));
  }
}

void ClearanceTable::advance(const BodyTwists& bodies) {
  if (blocks_.empty()) return;
  addTravel(bodies.rows(), blocks_, consumed_.data());
  has_consumed_ = true;
}

SkippedPairs ClearanceTable::finish(const BodyTwists& bodies, std::vector<DuePair>& due, double margin) {
  due.clear();
  if (blocks_.empty()) return {};
  std::size_t count = 0;
  SkippedPairs skipped =
      scanPairs({bodies.rows(), bodies.groups(), blocks_.data(), blocks_.size(), clearance_.data(), consumed_.data(),
                 slack_.data(), error_.data(), due_next_.data(), static_cast<float>(margin) * kUpwards},
                has_consumed_, due_blocks_.data(), &count);
  if (has_consumed_) std::fill(consumed_.begin(), consumed_.end(), 0.0F);
  has_consumed_ = false;
  if (skipped.pair >= 0) skipped.pair = pairs_[static_cast<std::size_t>(skipped.pair)];
  if (skipped.due_next >= 0) skipped.due_next = pairs_[static_cast<std::size_t>(skipped.due_next)];
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t slot = kTwistLanes * due_blocks_[k]; slot < kTwistLanes * (due_blocks_[k] + 1); ++slot) {
      if (pairs_[slot] < 0 || slack_[slot] > 0.0F) continue;
      due.push_back({std::isnan(slack_[slot]) ? kUnknownClearance : slack_[slot], pairs_[slot]});
    }
  }
  std::sort(due.begin(), due.end(),
            [](const DuePair& a, const DuePair& b) { return a.left != b.left ? a.left < b.left : a.pair < b.pair; });
  return skipped;
}

}  // namespace sdf_ccd
