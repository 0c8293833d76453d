// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_ADAPTIVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_ADAPTIVE_INL_H_
#undef SDF_CCD_LANE_ADAPTIVE_INL_H_
#else
#define SDF_CCD_LANE_ADAPTIVE_INL_H_
#endif

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "lane_crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// Which of its eight halves each lane is in.
inline VI halfOf(const VI* cell, VI log_half) {
  const VI one = whole(1);
  const auto bit = [&](VI c) { return hn::And(hn::Shr(c, log_half), one); };
  return hn::Or(bit(cell[0]), hn::Or(hn::ShiftLeft<1>(bit(cell[1])), hn::ShiftLeft<2>(bit(cell[2]))));
}

inline void enterSplits(MI split, const VI* cell, Blocks& b) {
  if (hn::AllFalse(n, split)) return;
  b.log_side = hn::IfThenElse(split, hn::Sub(b.log_side, whole(1)), b.log_side);
  const VI leaf = hn::Add(hn::Add(hn::ShiftLeft<3>(b.place), halfOf(cell, b.log_side)), whole(FlightQueue::kSplit));
  b.place = hn::IfThenElse(split, leaf, b.place);
}

/// By the top grid alone.
inline Blocks locateTop(const AdaptiveLanes& g, const VI* cell) {
  const VI word = topWord(g, cell);
  const VI kind = hn::And(word, whole(3));
  Blocks b;
  b.far = hn::Eq(kind, whole(0));
  b.node = hn::Eq(kind, whole(3));
  b.radius = hn::Mul(hn::BitCast(f, hn::AndNot(whole(3), word)), real(g.per_metre));
  b.log_side = whole(LaneBox::kLogUnits);
  b.place = hn::And(hn::ShiftRight<2>(word), whole(0x3FFFFFFF));
  enterSplits(hn::Eq(kind, whole(2)), cell, b);
  return b;
}

/// Below a top cell's node.
inline Blocks locateBelow(const AdaptiveLanes& g, const VI* cell, VI node_index) {
  Blocks b;
  b.far = b.node = none();
  b.radius = real(0.0F);
  b.log_side = whole(LaneBox::kLogUnits);
  b.place = hn::Zero(n);
  MI split = none(), node = hn::FirstN(n, hn::Lanes(n));
  int shift = LaneBox::kLogUnits - 2;
  for (int depth = 0; !hn::AllFalse(n, node); ++depth, shift -= 2) {
    const VI three = whole(3), by = whole(shift);
    const VI child =
        hn::Or(hn::And(hn::Shr(cell[0], by), three), hn::Or(hn::ShiftLeft<2>(hn::And(hn::Shr(cell[1], by), three)),
                                                            hn::ShiftLeft<4>(hn::And(hn::Shr(cell[2], by), three))));
    const VI place = hn::Add(hn::ShiftLeft<6>(node_index), child);
    const VI four = gather(g.codes, hn::ShiftRight<2>(place));
    const VI code = hn::And(hn::Shr(four, hn::ShiftLeft<3>(hn::And(place, three))), whole(255));
    const MI far = hn::And(node, hn::Gt(code, whole(node_code::kFar - 1)));
    const VI magnitude = hn::And(code, whole(31));
    const VI signed_steps = hn::IfThenElse(hn::Eq(hn::And(code, whole(32)), whole(0)), magnitude, hn::Neg(magnitude));
    const VF radius = hn::Mul(hn::ConvertTo(f, signed_steps), real(g.far_step[depth]));
    b.radius = hn::IfThenElse(asReal(far), radius, b.radius);
    b.far = hn::Or(b.far, far);
    b.log_side = hn::IfThenElse(node, by, b.log_side);
    const MI inner = hn::AndNot(far, node);
    if (hn::AllFalse(n, inner)) break;
    // Codes 0 to 63 are leaves, 64 to 127 nodes, 128 to 191 splits; a node's bases are those of leaves, splits, nodes.
    const VI rank = hn::And(code, whole(63));
    const MI is_node = hn::And(inner, hn::Eq(hn::ShiftRight<6>(code), whole(1)));
    const MI is_split = hn::And(inner, hn::Eq(hn::ShiftRight<6>(code), whole(2)));
    const VI which = hn::IfThenElse(is_node, whole(2), hn::IfThenElseZero(is_split, whole(1)));
    const VI safe = hn::IfThenElseZero(inner, node_index);
    const VI base = gather(g.bases, hn::Add(hn::Add(safe, hn::ShiftLeft<1>(safe)), which));
    const VI found = hn::Add(base, rank);
    b.place = hn::IfThenElse(inner, found, b.place);
    split = hn::Or(split, is_split);
    node = is_node;
    node_index = hn::IfThenElseZero(node, found);
  }
  enterSplits(split, cell, b);
  return b;
}

/// Of the lanes in `used`; in steps of the corners.
inline LeafCorners leafCorners(const AdaptiveLanes& g, const Lanes& lanes, MI used) {
  const VI leaf = lanes.place, log_side = lanes.log_side;
  const MI split = hn::Gt(leaf, whole(FlightQueue::kSplit - 1));
  const VI plain = hn::ShiftLeft<1>(hn::IfThenZeroElse(split, leaf));
  const bool some_plain = !hn::AllTrue(n, hn::Or(split, hn::Not(used)));
  VI low = some_plain ? gather(g.leaves, plain) : hn::Zero(n);
  VI high = some_plain ? gather(g.leaves + 1, plain) : hn::Zero(n);
  if (!hn::AllFalse(n, split)) {
    const VI half = hn::ShiftLeft<1>(hn::IfThenElseZero(split, hn::Sub(leaf, whole(FlightQueue::kSplit))));
    low = hn::IfThenElse(split, gather(g.splits, half), low);
    high = hn::IfThenElse(split, gather(g.splits + 1, half), high);
  }
  const VI byte = whole(0x7F);
  const auto step = [&](VI word) { return hn::ConvertTo(f, hn::And(word, byte)); };
  LeafCorners corners{
      {step(low), step(hn::ShiftRight<8>(low)), step(hn::ShiftRight<16>(low)), step(hn::ShiftRight<24>(low)),
       step(high), step(hn::ShiftRight<8>(high)), step(hn::ShiftRight<16>(high)), step(hn::ShiftRight<24>(high))},
      {}};
  const auto topBits = [](VI word) {
    const VI bits =
        hn::And(hn::BitCast(n, hn::ShiftRight<7>(hn::BitCast(hn::RebindToUnsigned<I>(), word))), whole(0x01010101));
    const auto packed = hn::BitCast(hn::RebindToUnsigned<I>(), hn::Mul(bits, whole(0x10204080)));
    return hn::BitCast(n, hn::ShiftRight<28>(packed));
  };
  const VI offset_bits = hn::Or(topBits(low), hn::ShiftLeft<4>(topBits(high)));
  const VF offset = hn::ConvertTo(f, hn::ShiftRight<24>(hn::ShiftLeft<24>(offset_bits)));
  // The isovalue in the corners' steps.
  const VF side = hn::ConvertTo(f, hn::Shl(whole(1), log_side));
  const VF offset_step = hn::MulAdd(side, real(g.offset_per_side), real(g.offset));
  const VF corner_step = hn::MulAdd(side, real(g.corner_per_side), real(g.corner));
  const VF scale = hn::Div(real(1.0F), corner_step);
  const VF shifted = hn::NegMulAdd(offset, offset_step, real(g.sigma));
  corners.iso = hn::MulAdd(shifted, scale, real(63.5F));
  return corners;
}

inline void prefetchNode(const AdaptiveLanes& g, const FlightQueue& queue, int i) {
  hwy::Prefetch(g.codes + 16 * std::size_t(queue.place[i]));
  hwy::Prefetch(g.bases + 3 * std::size_t(queue.place[i]));
}

inline void prefetchLeaf(const AdaptiveLanes& g, const FlightQueue& queue, int i) {
  const std::int32_t place = queue.place[i];
  hwy::Prefetch(place >= FlightQueue::kSplit ? g.splits + 2 * (place - FlightQueue::kSplit) : g.leaves + 2 * place);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
