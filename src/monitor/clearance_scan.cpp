#include "clearance_scan.h"

#include <tuple>
#include <utility>

#include "common/lane_vector.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

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
  SDF_CCD_INLINE void update(const Floats& values, std::size_t block) {
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

/// Clearances after a displacement. Each of the two subtractions has an error of at most half of kUnit times the
/// clearance, or where more is used up than that, times what is used up, of which kUpwards adds more to the
/// displacement; there is none without motion.
template <class Numbers>
SDF_CCD_INLINE Numbers clearanceAfter(const Numbers& clearance, const Numbers& travel) {
  const Numbers none{};
  const Numbers size = clearance < none ? -clearance : clearance;
  return (clearance - travel) - (travel > none ? size * kUnit : none);
}

}  // namespace

SDF_CCD_LANES
void addTravel(const float* rows, const std::vector<PairBlock>& blocks, float* consumed) {
  OneBody a;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (i == 0 || blocks[i].rows_a != blocks[i - 1].rows_a) a.load(rows + blocks[i].rows_a);
    const BodiesInRow b{rows + static_cast<std::size_t>(blocks[i].group) * kTwistBlock};
    const std::size_t at = i * kTwistLanes;
    store((load(consumed + at) + travelOf(a, b)) * kUpwards, consumed + at);
  }
}

SDF_CCD_LANES
SkippedPairs scanPairs(const ScanArrays& s, bool add_consumed, std::size_t* due_blocks, std::size_t* due_count) {
  Largest error_bound(-1.0F), overdue(0.0F);
  SkippedPairs waiting;  // of the blocks that are not scanned
  const Floats zero = {};
  std::size_t found = 0;
  OneBody a;
  std::int32_t loaded = -1;
  for (std::size_t i = 0; i < s.count; ++i) {
    PairBlock& block = s.blocks[i];
    const TwistGroup& group = s.groups[block.group];
    const bool may_wait = group.rests && !add_consumed;
    if (may_wait) {
      const BesideResting one(s.rows + block.rows_a);
      const float travel = one.travelBeside(group), error = one.poseErrorBeside(group);
      const float path = travel > 0.0F ? (block.path + travel) * kUpwards : block.path;
      if (clearanceAfter(block.least, path) > error + s.margin + kDueNext * travel) {  // false for NaN
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
    if (add_consumed) travel = (travel + load(s.consumed + at)) * kUpwards;
    const Floats left = has_pair ? clearanceAfter(clearance, travel) : clearance;
    const Floats error = poseErrorOf(a, b);
    const Floats needed = error + s.margin;
    const Ints is_skipped = left > needed;  // false for NaN
    store(is_skipped ? left : clearance, s.clearance + at);
    store(left - needed, s.slack + at);
    const Floats bound = is_skipped ? load(s.error + at) + error : zero - 1.0F;
    error_bound.update(bound, i);
    overdue.update(is_skipped ? load(s.due_next + at) * travel - (left - needed) : zero, i);
    const bool all_skipped = allTrue(is_skipped | ~has_pair);
    due_blocks[found] = i;
    found += all_skipped ? 0 : 1;
    block.path = 0.0F;
    block.least = may_wait && all_skipped ? leastOf(left) : kUnknownClearance;
  }
  *due_count = found;
  SkippedPairs skipped;
  std::tie(skipped.error, skipped.pair) = error_bound.get();
  if (waiting.error > skipped.error) skipped = waiting;
  skipped.due_next = overdue.get().second;
  return skipped;
}

}  // namespace sdf_ccd
