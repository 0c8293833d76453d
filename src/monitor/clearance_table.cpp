#include "clearance_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "common/lane_vector.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

constexpr float kNoPair = 1e30F;  // a clearance that is never used up, for lanes without a pair
constexpr float kUpwards = 1.0F + 0x1p-20F;
constexpr float kSoon = 2.0F, kPaused = -1.0F;
constexpr float kUnit = 0x1p-23F;  // twice the relative rounding error

using Vector = LaneVector<Floats>;

SDF_CCD_INLINE Floats norm(const Vector& v) {
  return squareRoot(v.dot(v));
}

/// The rows of one body, in all lanes.
class OneBody {
 public:
  SDF_CCD_INLINE void load(const float* first) {
#pragma GCC unroll 32
    for (int row = 0; row < static_cast<int>(TwistRow::kCount); ++row) rows_[row] = first[row * kTwistLanes] - Floats{};
  }
  SDF_CCD_INLINE Floats operator()(TwistRow row, int offset = 0) const {
    return rows_[static_cast<int>(row) + offset];
  }

 private:
  Floats rows_[static_cast<int>(TwistRow::kCount)] = {};
};

/// The rows of consecutive bodies.
struct BodiesInRow {
  const float* first;

  SDF_CCD_INLINE Floats operator()(TwistRow row, int offset = 0) const {
    return load(first + (static_cast<std::size_t>(row) + static_cast<std::size_t>(offset)) * kTwistLanes);
  }
};

template <class Get>
SDF_CCD_INLINE Vector vectorOf(const Get& get, TwistRow row) {
  return {get(row, 0), get(row, 1), get(row, 2)};
}

/// Upper bound of the displacement of one body's points relative to the other in a step (RelativeMotionBounds::travel,
/// about the reference points). Takes the smaller value of the two bodies' balls.
///
/// With twists about the points a and b, d = a − b and w = v_A − v_B, body A moves at a with w − ω_B × d
/// relative to B, and body B moves at b with −(w − ω_A × d) relative to A. At other points the velocity differs
/// by the difference of rotations times the distance from there, whose average over the step is at most kReach.
///
/// Rounding, with u = 2^-24, V = |v_A| + |v_B|, Ω = |ω_A| + |ω_B|, C = |a| + |b| ≥ |d|: the inputs have errors of
/// u each, so d has 2 u C, w has 2 u V and the difference of rotations 2 u Ω. A cross product adds 6 u Ω |d|, so the
/// error of w − ω × d is (3 V + 10.1 Ω C) u. A norm adds 3 u of itself, the product of reach and rotation
/// difference 6 u Ω reach, and the sum and the smaller of both 2 u of V + Ω (C + reach). The total is less than 7 u V
/// + 15 u Ω (C + reach), where C + reach is at most the sum of both kFar. kTurnNoise and kShiftNoise contain 32 u
/// each.
template <class A, class B>
SDF_CCD_INLINE Floats travelOf(const A& a, const B& b) {
  const Vector omega_a = vectorOf(a, TwistRow::kOmega), omega_b = vectorOf(b, TwistRow::kOmega);
  const Vector d = vectorOf(a, TwistRow::kPoint) - vectorOf(b, TwistRow::kPoint);
  const Vector w = vectorOf(a, TwistRow::kVelocity) - vectorOf(b, TwistRow::kVelocity);
  const Floats rotation = norm(omega_a - omega_b);
  const Floats by_a = norm(w - omega_b.cross(d)) + rotation * a(TwistRow::kReach) + a(TwistRow::kOpen);
  const Floats by_b = norm(w - omega_a.cross(d)) + rotation * b(TwistRow::kReach) + b(TwistRow::kOpen);
  const Floats noise = (a(TwistRow::kTurnNoise) + b(TwistRow::kTurnNoise)) * (a(TwistRow::kFar) + b(TwistRow::kFar)) +
                       (a(TwistRow::kShiftNoise) + b(TwistRow::kShiftNoise));
  // The last factor also covers the error of a contact's time, 1e-9 of the path.
  return (smaller(by_a, by_b) + noise) * kUpwards;
}

/// Error of the distance from poses and motions.
template <class A, class B>
SDF_CCD_INLINE Floats poseErrorOf(const A& a, const B& b) {
  const Floats far = a(TwistRow::kFarthest) + b(TwistRow::kFarthest);
  return ((a(TwistRow::kTilt) + b(TwistRow::kTilt)) * far + (a(TwistRow::kError) + b(TwistRow::kError))) * kUpwards;
}

/// The largest value of a scan above a given one, and its slot.
class Largest {
 public:
  SDF_CCD_INLINE explicit Largest(float above) : values_(Floats{} + above), above_(above) {}
  SDF_CCD_INLINE void take(const Floats& values, std::size_t block) {
    const Ints is_more = values > values_;
    values_ = is_more ? values : values_;
    blocks_ = is_more ? Ints{} + static_cast<std::int32_t>(block) : blocks_;
  }
  /// The value and its slot; the given value and −1 if there is none above it.
  SDF_CCD_INLINE std::pair<float, int> get() const {
    std::pair<float, int> largest = {above_, -1};
    for (int lane = 0; lane < kFloatWidth; ++lane)
      if (values_[lane] > largest.first) largest = {values_[lane], blocks_[lane] * kFloatWidth + lane};
    return largest;
  }

 private:
  Floats values_;
  Ints blocks_ = {};
  float above_;
};

SDF_CCD_INLINE bool allTrue(const Ints& lanes) {
  const auto pairs = reinterpret_cast<LongInts>(lanes);  // of lanes; a lane is −1 if true
  return (pairs[0] & pairs[1] & pairs[2] & pairs[3]) == -1;
}

/// The values of a body that are needed beside others that rest.
struct BesideResting {
  float path, turn_noise, far, farthest, tilt, error;

  SDF_CCD_INLINE explicit BesideResting(const float* first) {
    const auto get = [&](TwistRow row) __attribute__((always_inline)) {
      return first[static_cast<std::size_t>(row) * kTwistLanes];
    };
    path = get(TwistRow::kPath) + get(TwistRow::kShiftNoise);
    turn_noise = get(TwistRow::kTurnNoise);
    far = get(TwistRow::kFar);
    farthest = get(TwistRow::kFarthest);
    tilt = get(TwistRow::kTilt);
    error = get(TwistRow::kError);
  }

  /// Upper bounds of what travelOf() and poseErrorOf() are for the pairs with a group. In travelOf(), w and ω are those
  /// of the one body, and noise of the others is zero.
  SDF_CCD_INLINE float travelBeside(const TwistGroup& group) const {
    return (path + turn_noise * (far + group.far)) * kUpwards;
  }
  SDF_CCD_INLINE float poseErrorBeside(const TwistGroup& group) const {
    return (tilt * (farthest + group.farthest) + group.tilt * farthest + group.swing + (error + group.error)) *
           kUpwards;
  }
};

SDF_CCD_LANES
void addTravel(const float* rows, const std::vector<PairBlock>& blocks, float* spent) {
  OneBody a;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i == 0 || blocks[i].rows_a != blocks[i - 1].rows_a) a.load(rows + blocks[i].rows_a);
    const BodiesInRow b{rows + static_cast<std::size_t>(blocks[i].group) * kTwistBlock};
    const std::size_t at = i * kTwistLanes;
    store((load(spent + at) + travelOf(a, b)) * kUpwards, spent + at);
  }
}

/// Arrays of a scan, in the order of the blocks.
struct ScanArrays {
  const float* rows;
  const TwistGroup* groups;
  PairBlock* blocks;
  std::size_t count;
  float* clearance;
  float* spent;
  float* slack;
  const float* error;
  const float* soon;
  float margin;
};

/// Clearances after a displacement. Each of the two subtractions has an error of at most half of kUnit times the
/// clearance, or where more is used up than that, times what is used up, of which kUpwards adds more to the
/// displacement; there is none without motion.
template <class Numbers>
SDF_CCD_INLINE Numbers clearanceAfter(const Numbers& clearance, const Numbers& travel) {
  const Numbers none{};
  const Numbers size = clearance < none ? -clearance : clearance;
  return (clearance - travel) - (travel > none ? size * kUnit : none);
}

/// Sets `slack` to what remains after the error, and `clearance` for the pairs that are not due. @return the largest
/// error and its slot, and the slot of the pair that will be due soon.
SDF_CCD_LANES
SkippedPairs scanPairs(const ScanArrays& s, bool add_spent, std::size_t* due_blocks, std::size_t* due_count) {
  Largest error_bound(-1.0F), overdue(0.0F);
  SkippedPairs waiting;  // of the blocks that are not scanned
  const Floats zero = {};
  std::size_t found = 0;
  OneBody a;
  std::int32_t loaded = -1;
  for (std::size_t i = 0; i < s.count; ++i) {
    PairBlock& block = s.blocks[i];
    const TwistGroup& group = s.groups[block.group];
    const bool may_wait = group.rests && !add_spent;
    if (may_wait) {
      const BesideResting one(s.rows + block.rows_a);
      const float travel = one.travelBeside(group), error = one.poseErrorBeside(group);
      const float path = travel > 0.0F ? (block.path + travel) * kUpwards : block.path;
      if (clearanceAfter(block.least, path) > error + s.margin + kSoon * travel) {  // false for NaN
        block.path = path;
        if (block.error + error > waiting.error) waiting = {block.error + error, block.worst, -1};
        continue;
      }
    }
    if (loaded != block.rows_a) a.load(s.rows + block.rows_a);
    loaded = block.rows_a;
    const BodiesInRow b{s.rows + static_cast<std::size_t>(block.group) * kTwistBlock};
    const std::size_t at = i * kTwistLanes;
    Floats clearance = load(s.clearance + at);
    const Ints has_pair = ~(clearance >= kNoPair);
    if (block.path > 0.0F) clearance = has_pair ? clearanceAfter(clearance, zero + block.path) : clearance;
    Floats travel = travelOf(a, b);
    if (add_spent) travel = (travel + load(s.spent + at)) * kUpwards;
    const Floats left = has_pair ? clearanceAfter(clearance, travel) : clearance;
    const Floats error = poseErrorOf(a, b);
    const Floats needed = error + s.margin;
    const Ints is_quiet = left > needed;  // false for NaN
    store(is_quiet ? left : clearance, s.clearance + at);
    store(left - needed, s.slack + at);
    const Floats bound = is_quiet ? load(s.error + at) + error : zero - 1.0F;
    error_bound.take(bound, i);
    overdue.take(is_quiet ? load(s.soon + at) * travel - (left - needed) : zero, i);
    const bool all_quiet = allTrue(is_quiet | ~has_pair);
    due_blocks[found] = i;
    found += all_quiet ? 0 : 1;
    block.path = 0.0F;
    block.least = may_wait && all_quiet ? leastOf(left) : ClearanceTable::kUnknown;
  }
  *due_count = found;
  SkippedPairs quiet;
  std::tie(quiet.error, quiet.pair) = error_bound.get();
  if (waiting.error > quiet.error) quiet = waiting;
  quiet.soon = overdue.get().second;
  return quiet;
}

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
  spent_.assign(pairs_.size(), 0.0F);
  slack_.assign(pairs_.size(), 0.0F);
  error_.assign(pairs_.size(), -kNoPair);
  soon_.assign(pairs_.size(), kSoon);
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
void ClearanceTable::settle(PairBlock& block) {
  block.least = kUnknown;
  if (!(block.path > 0.0F)) return;
  const auto first = static_cast<std::size_t>(&block - blocks_.data()) * kTwistLanes;
  for (std::size_t slot = first; slot < first + kTwistLanes; ++slot)
    if (pairs_[slot] >= 0) clearance_[slot] = roundedDown(clearanceIn(slot));
  block.path = 0.0F;
}

/// A pair's clearance, to be changed.
float& ClearanceTable::settled(int pair) {
  settle(blocks_[blockOf(slot(pair))]);
  return clearance_[slot(pair)];
}

void ClearanceTable::set(int pair, double clearance) {
  constexpr double kFar = 1e6;  // [m]: farther pairs are tested earlier than necessary
  settled(pair) = roundedDown(std::min(clearance, kFar));
  soon_[slot(pair)] = kSoon;
}

void ClearanceTable::pauseSoon(int pair) {
  soon_[slot(pair)] = kPaused;
}

void ClearanceTable::spend(int pair, double displacement) {
  float& clearance = settled(pair);
  clearance = roundedDown(double(clearance) - displacement);
  if (!(clearance > 0.0F)) clearance = kUnknown;
}

void ClearanceTable::forget(int pair) {
  settled(pair) = kUnknown;
}

void ClearanceTable::forget() {
  for (PairBlock& block : blocks_) settle(block);
  for (const std::int32_t slot : slots_)
    if (slot >= 0) clearance_[static_cast<std::size_t>(slot)] = kUnknown;
}

void ClearanceTable::take(const ClearanceTable& other, const std::vector<int>& pairs_now) {
  for (PairBlock& block : blocks_) settle(block);
  for (std::size_t pair = 0; pair < pairs_now.size(); ++pair) {
    const int now = pairs_now[pair];
    if (now < 0 || !holds(now)) continue;
    clearance_[slot(now)] = roundedDown(other.clearanceIn(other.slot(static_cast<int>(pair))));
  }
}

void ClearanceTable::advance(const BodyTwists& bodies) {
  if (blocks_.empty()) return;
  addTravel(bodies.rows(), blocks_, spent_.data());
  has_spent_ = true;
}

SkippedPairs ClearanceTable::finish(const BodyTwists& bodies, std::vector<DuePair>& due, double margin) {
  due.clear();
  if (blocks_.empty()) return {};
  std::size_t count = 0;
  SkippedPairs quiet =
      scanPairs({bodies.rows(), bodies.groups(), blocks_.data(), blocks_.size(), clearance_.data(), spent_.data(),
                 slack_.data(), error_.data(), soon_.data(), static_cast<float>(margin) * kUpwards},
                has_spent_, due_blocks_.data(), &count);
  if (has_spent_) std::fill(spent_.begin(), spent_.end(), 0.0F);
  has_spent_ = false;
  if (quiet.pair >= 0) quiet.pair = pairs_[static_cast<std::size_t>(quiet.pair)];
  if (quiet.soon >= 0) quiet.soon = pairs_[static_cast<std::size_t>(quiet.soon)];
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t slot = kTwistLanes * due_blocks_[k]; slot < kTwistLanes * (due_blocks_[k] + 1); ++slot) {
      if (pairs_[slot] < 0 || slack_[slot] > 0.0F) continue;
      due.push_back({std::isnan(slack_[slot]) ? kUnknown : slack_[slot], pairs_[slot]});
    }
  }
  std::sort(due.begin(), due.end(),
            [](const DuePair& a, const DuePair& b) { return a.left != b.left ? a.left < b.left : a.pair < b.pair; });
  return quiet;
}

}  // namespace sdf_ccd
