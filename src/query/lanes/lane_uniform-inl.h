// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_UNIFORM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_UNIFORM_INL_H_
#undef SDF_CCD_LANE_UNIFORM_INL_H_
#else
#define SDF_CCD_LANE_UNIFORM_INL_H_
#endif

#include <cstring>

#include <hwy/highway.h>

#include "lane_crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// Decodes the words of bricks: if the lowest bit is 1, a slot in the others; else an empty sphere.
inline Blocks locateTop(const UniformLanes& g, VI word, const VI* /*cell*/) {
  Blocks b;
  b.far = hn::Eq(hn::And(word, whole(1)), hn::Zero(n));
  b.node = hn::Not(b.far);
  setEmptySphere(g, word, b);
  b.log_side = whole(LaneBox::kLogUnits);
  b.index = hn::IfThenElseZero(b.node, hn::ShiftRight<1>(word));
  return b;
}

/// The sample that is nearest to each lane in its brick.
struct NearestSample {
  VI x[3];       ///< 0 to 8
  VF center[3];  ///< [units]

  explicit NearestSample(const Lanes& lanes) {
    constexpr float kCell = 1 << UniformLanes::kLogCell;
    for (int k = 0; k < 3; ++k) {
      const VI low = hn::And(lanes.cell[k], whole(-LaneBox::kUnits));
      const VF from_low = hn::Sub(lanes.at(k), hn::ConvertTo(f, low));
      const VI nearest = truncated(hn::MulAdd(from_low, real(1.0F / kCell), real(0.5F)));
      x[k] = hn::Min(hn::Max(nearest, hn::Zero(n)), whole(GridShape::kBrick));
      center[k] = hn::ConvertTo(f, hn::Add(low, hn::ShiftLeft<UniformLanes::kLogCell>(x[k])));
    }
  }
};

/// Reads the samples that are nearest to the rays.
inline void fetchBelow(const UniformLanes& g, const RayQueue& queue, Fetched& fetched) {
  const MI all = hn::FirstN(n, hn::Lanes(n));
  for (int i = 0; i < queue.size; i += static_cast<int>(hn::Lanes(n))) {
    const NearestSample nearest(Lanes(queue, i, all));
    const VI row = hn::Add(hn::Mul(nearest.x[2], whole(GridShape::kSide)), nearest.x[1]);
    hn::StoreU(hn::Add(hn::Mul(row, whole(GridShape::kSide)), nearest.x[0]), n, fetched.word.data() + i);
  }
  const auto sampleOf = [&](int i) { return std::size_t(queue.index[i]) * GridShape::kSamples + fetched.word[i]; };
  for (int i = 0; i < queue.size; ++i) fetched.word[i] = g.samples[sampleOf(i)];
}

/// The sphere about the sample nearest to each lane, in a brick: no point of it has the value sigma (design §3.3).
struct SampleBall {
  VF center[3];  ///< [units]
  VF radius2;    ///< [units²]; negative: none
  MI inside;     ///< its points are below sigma
};

inline SampleBall nearestBall(const UniformLanes& g, const Lanes& lanes, const Fetched& fetched, int first) {
  constexpr float kCell = 1 << UniformLanes::kLogCell;
  const NearestSample nearest(lanes);
  SampleBall ball{{nearest.center[0], nearest.center[1], nearest.center[2]}, {}, {}};
  const VI word = hn::LoadU(n, fetched.word.data() + first);
  const VF above = hn::Sub(hn::ConvertTo(f, word), real(g.sigma));
  ball.inside = asWhole(hn::Lt(above, real(0.0F)));
  // Reduced by the rounding of single precision.
  const VF free = hn::MulAdd(hn::Abs(above), real(g.per_sample * (1.0F - 1e-5F)), real(-0.02F - g.rounding));
  const VF radius2 = hn::MulSub(free, free, real(0.75F * kCell * kCell));
  ball.radius2 = hn::IfThenElse(hn::Gt(free, real(0.0F)), radius2, real(-1.0F));
  return ball;
}

/// Reads the corners of the rays' cells: those that are adjacent along x are in one word.
inline void fetchLeaves(const UniformLanes& g, const RayQueue& queue, Fetched& fetched) {
  constexpr int kSide = GridShape::kSide;
  for (int i = 0; i < queue.size; ++i) {
    const auto in_brick = [&](int k) { return (queue.cell[k][i] >> UniformLanes::kLogCell) & (GridShape::kBrick - 1); };
    const std::int16_t* first = g.samples + std::size_t(queue.index[i]) * GridShape::kSamples +
                                (in_brick(2) * kSide + in_brick(1)) * kSide + in_brick(0);
    const std::int16_t* pairs[] = {first, first + kSide, first + kSide * kSide, first + kSide * kSide + kSide};
    for (int k = 0; k < 4; ++k) std::memcpy(&fetched.pairs[k][i], pairs[k], sizeof(std::int32_t));
  }
}

/// The corner values of each lane's cell, in steps.
inline LeafCorners leafCorners(const UniformLanes& g, const Lanes& /*lanes*/, const Fetched& fetched, int first) {
  LeafCorners corners;
  for (int k = 0; k < 4; ++k) {
    const VI both = hn::LoadU(n, fetched.pairs[k].data() + first);  // the left one's bits are the lower ones
    corners.corner[2 * k] = hn::ConvertTo(f, hn::ShiftRight<16>(hn::ShiftLeft<16>(both)));
    corners.corner[2 * k + 1] = hn::ConvertTo(f, hn::ShiftRight<16>(both));
  }
  corners.iso = real(g.sigma);
  corners.step = real(g.per_sample);
  return corners;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
