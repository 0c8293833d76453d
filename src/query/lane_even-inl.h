// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_EVEN_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_EVEN_INL_H_
#undef SDF_CCD_LANE_EVEN_INL_H_
#else
#define SDF_CCD_LANE_EVEN_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "lane_crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// By the bricks: 1 in the last bit, and a slot above it; or a distance.
inline Blocks locateTop(const EvenLanes& g, const VI* cell) {
  const VI word = topWord(g, cell);
  Blocks b;
  b.far = hn::Eq(hn::And(word, whole(1)), hn::Zero(n));
  b.node = hn::Not(b.far);
  b.radius = hn::Mul(hn::BitCast(f, word), real(g.per_metre));
  b.log_side = whole(LaneBox::kLogUnits);
  b.place = hn::IfThenElseZero(b.node, hn::ShiftRight<1>(word));
  return b;
}

/// Index of a sample of each lane's brick, `x` of 0 to 8 per axis.
inline VI sampleIndex(VI slot, const VI* x) {
  const VI row = hn::Add(hn::Mul(x[2], whole(GridShape::kSide)), x[1]);
  const VI in_brick = hn::Add(hn::Mul(row, whole(GridShape::kSide)), x[0]);
  return hn::Add(hn::Mul(slot, whole(GridShape::kSamples)), in_brick);
}

/// The ball about the sample nearest to each lane, in a brick: no place of it has the value sigma (design §3.3).
struct SampleBall {
  VF center[3];  ///< [units]
  VF radius2;    ///< [units²]; negative: none
  MI inside;     ///< its places are below sigma
};

inline SampleBall nearestBall(const EvenLanes& g, const Lanes& lanes) {
  constexpr float kCell = 1 << EvenLanes::kLogCell;
  SampleBall ball;
  VI x[3];
  for (int k = 0; k < 3; ++k) {
    const VI low = hn::And(lanes.cell[k], whole(-LaneBox::kUnits));
    const VF from_low = hn::Sub(lanes.at(k), hn::ConvertTo(f, low));
    const VI nearest = hn::ConvertTo(n, hn::MulAdd(from_low, real(1.0F / kCell), real(0.5F)));
    x[k] = hn::Min(hn::Max(nearest, hn::Zero(n)), whole(GridShape::kBrick));
    ball.center[k] = hn::ConvertTo(f, hn::Add(low, hn::ShiftLeft<EvenLanes::kLogCell>(x[k])));
  }
  const VF value = hn::GatherIndex(f, g.samples, sampleIndex(lanes.place, x));
  const VF above = hn::Sub(value, real(g.sigma));
  ball.inside = asWhole(hn::Lt(above, real(0.0F)));
  // Less what single precision makes of it.
  const VF free = hn::MulAdd(hn::Abs(above), real(g.per_metre * (1.0F - 1e-5F)), real(-0.02F));
  const VF radius2 = hn::MulSub(free, free, real(0.75F * kCell * kCell));
  ball.radius2 = hn::IfThenElse(hn::Gt(free, real(0.0F)), radius2, real(-1.0F));
  return ball;
}

/// Of each lane's cell, in metres.
inline LeafCorners leafCorners(const EvenLanes& g, const Lanes& lanes, MI /*used*/) {
  VI x[3];
  for (int k = 0; k < 3; ++k) {
    x[k] = hn::And(hn::ShiftRight<EvenLanes::kLogCell>(lanes.cell[k]), whole(GridShape::kBrick - 1));
  }
  const VI first = sampleIndex(lanes.place, x);
  constexpr int kY = GridShape::kSide, kZ = GridShape::kSide * GridShape::kSide;
  const auto at = [&](int offset) { return hn::GatherIndex(f, g.samples + offset, first); };
  return {{at(0), at(1), at(kY), at(kY + 1), at(kZ), at(kZ + 1), at(kZ + kY), at(kZ + kY + 1)}, real(g.sigma)};
}

inline const float* firstSample(const EvenLanes& g, const FlightQueue& queue, int i) {
  constexpr int kSide = GridShape::kSide;
  const auto in_brick = [&](int k) { return (queue.cell[k][i] >> EvenLanes::kLogCell) & (GridShape::kBrick - 1); };
  return g.samples + std::size_t(queue.place[i]) * GridShape::kSamples + (in_brick(2) * kSide + in_brick(1)) * kSide +
         in_brick(0);
}

inline void prefetchNode(const EvenLanes& g, const FlightQueue& queue, int i) {
  hwy::Prefetch(firstSample(g, queue, i));
}

inline void prefetchLeaf(const EvenLanes& g, const FlightQueue& queue, int i) {
  const float* first = firstSample(g, queue, i);
  hwy::Prefetch(first);
  hwy::Prefetch(first + GridShape::kSide * GridShape::kSide);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
