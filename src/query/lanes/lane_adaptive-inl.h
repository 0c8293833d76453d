// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_ADAPTIVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_ADAPTIVE_INL_H_
#undef SDF_CCD_LANE_ADAPTIVE_INL_H_
#else
#define SDF_CCD_LANE_ADAPTIVE_INL_H_
#endif

#include <cstring>

#include <hwy/highway.h>

#include "lane_crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

/// The octant of its block that each lane is in.
inline VI halfOf(const VI* cell, VI log_half) {
  const VI one = whole(1);
  const auto bit = [&](VI c) { return hn::And(hn::Shr(c, log_half), one); };
  return hn::Or(bit(cell[0]), hn::Or(hn::ShiftLeft<1>(bit(cell[1])), hn::ShiftLeft<2>(bit(cell[2]))));
}

inline void enterSplits(MI split, const VI* cell, Blocks& b) {
  if (hn::AllFalse(n, split)) return;
  b.log_side = hn::IfThenElse(split, hn::Sub(b.log_side, whole(1)), b.log_side);
  const VI leaf = hn::Add(hn::Add(hn::ShiftLeft<3>(b.index), halfOf(cell, b.log_side)), whole(RayQueue::kSplit));
  b.index = hn::IfThenElse(split, leaf, b.index);
}

/// Decodes the words of the lanes' top cells.
inline Blocks locateTop(const AdaptiveLanes& g, VI word, const VI* cell) {
  const VI kind = hn::And(word, whole(3));
  Blocks b;
  b.far = hn::Eq(kind, whole(0));
  b.node = hn::Eq(kind, whole(3));
  setEmptySphere(g, word, b);
  b.log_side = whole(LaneBox::kLogUnits);
  const hn::RebindToUnsigned<I> bits;
  b.index = hn::BitCast(n, hn::ShiftRight<2>(hn::BitCast(bits, word)));
  enterSplits(hn::Eq(kind, whole(2)), cell, b);
  return b;
}

/// Reads the codes of the children that rays are in, and the index of the first child of that kind.
inline void fetchBelow(const AdaptiveLanes& g, const RayQueue& queue, Fetched& fetched) {
  const VI three = whole(3);
  for (int i = 0; i < queue.size; i += static_cast<int>(hn::Lanes(n))) {
    const VI log_child = hn::Max(hn::Sub(hn::LoadU(n, queue.log_side.data() + i), whole(2)), hn::Zero(n));
    const auto step = [&](int k) { return hn::And(hn::Shr(hn::LoadU(n, queue.cell[k].data() + i), log_child), three); };
    const VI child = hn::Or(step(0), hn::Or(hn::ShiftLeft<2>(step(1)), hn::ShiftLeft<4>(step(2))));
    hn::StoreU(child, n, fetched.word.data() + i);
  }
  const AdaptiveNode* nodes = g.nodes;
  const NodeBases* bases = g.bases;
  const std::int32_t* index = queue.index.data();
  std::int32_t *word = fetched.word.data(), *base = fetched.base.data();
  for (int i = 0, size = queue.size; i < size; ++i) {
    const int code = nodes[index[i]].codes[word[i]];
    const NodeBases& by_kind = bases[index[i]];
    const std::uint32_t not_leaf = code < node_code::kSplit ? by_kind.node : by_kind.split;
    word[i] = code;
    const bool leaf = code < node_code::kNode || code >= node_code::kWide;
    base[i] = static_cast<std::int32_t>(leaf ? by_kind.leaf : not_leaf);
  }
}

/// Decodes the lanes' children; lanes.log_side is their parent's.
inline Blocks locateBelow(const AdaptiveLanes& g, const Lanes& lanes, const Fetched& fetched, int first) {
  const VI code = hn::LoadU(n, fetched.word.data() + first), base = hn::LoadU(n, fetched.base.data() + first);
  // Codes 0 to 63 are leaves, 64 to 127 nodes, 128 to 191 splits, and from 192 on far, but the last eight wide leaves.
  const VI kind = hn::ShiftRight<6>(code);
  const MI wide = hn::Gt(code, whole(node_code::kWide - 1));
  Blocks b;
  b.far = hn::AndNot(wide, hn::Eq(kind, whole(3)));
  b.node = hn::Eq(kind, whole(1));
  b.log_side = hn::Sub(lanes.log_side, hn::IfThenElse(wide, whole(1), whole(2)));
  const VF steps = hn::ConvertTo(f, hn::And(code, whole(31)));
  const VF parent = hn::ConvertTo(f, hn::Shl(whole(1), lanes.log_side));
  b.radius = hn::Mul(steps, hn::MulAdd(parent, real(g.far_step_per_side), real(g.far_step)));
  b.inside = hn::Ne(hn::And(code, whole(32)), whole(0));
  for (VF& ball : b.ball) ball = hn::Mul(parent, real(0.125F));
  b.index = hn::Add(base, hn::And(code, hn::IfThenElse(wide, whole(7), whole(63))));
  enterSplits(hn::Eq(kind, whole(2)), lanes.cell, b);
  return b;
}

inline void fetchLeaves(const AdaptiveLanes& g, const RayQueue& queue, Fetched& fetched) {
  // Selected by an index rather than a branch, which the processor could not predict.
  const LeafWord* const leaves[] = {g.leaves, g.splits ? g.splits->leaves.data() : nullptr};
  const std::int32_t* index = queue.index.data();
  std::int32_t* pair = fetched.pairs[0].data();
  for (int i = 0, size = queue.size; i < size; ++i) {
    const LeafWord* leaf = leaves[index[i] >= RayQueue::kSplit] + (index[i] & (RayQueue::kSplit - 1));
    // NOLINTNEXTLINE(clang-analyzer-core.NonNullParamChecker): there are splits where an index says so
    std::memcpy(pair + 2 * i, leaf, sizeof(LeafWord));
  }
}

/// The corner values of each lane's leaf, in steps of LeafCorners::step.
inline LeafCorners leafCorners(const AdaptiveLanes& g, const Lanes& lanes, const Fetched& fetched, int first) {
  VI low, high;
  hn::LoadInterleaved2(n, fetched.pairs[0].data() + 2 * first, low, high);
  const VI byte = whole(0x7F);
  const auto step = [&](VI word) { return hn::ConvertTo(f, hn::And(word, byte)); };
  LeafCorners corners;
  const VI words[] = {low, high};
  for (int k = 0; k < 2; ++k) {
    VF* corner = corners.corner + 4 * k;
    corner[0] = step(words[k]);
    corner[1] = step(hn::ShiftRight<8>(words[k]));
    corner[2] = step(hn::ShiftRight<16>(words[k]));
    corner[3] = step(hn::ShiftRight<24>(words[k]));
  }
  const auto topBits = [](VI word) {
    const VI bits =
        hn::And(hn::BitCast(n, hn::ShiftRight<7>(hn::BitCast(hn::RebindToUnsigned<I>(), word))), whole(0x01010101));
    const auto packed = hn::BitCast(hn::RebindToUnsigned<I>(), hn::Mul(bits, whole(0x10204080)));
    return hn::BitCast(n, hn::ShiftRight<28>(packed));
  };
  const VI offset_bits = hn::Or(topBits(low), hn::ShiftLeft<4>(topBits(high)));
  const VF offset = hn::ConvertTo(f, hn::ShiftRight<24>(hn::ShiftLeft<24>(offset_bits)));
  // The isovalue in the corners' steps.
  const VF side = hn::ConvertTo(f, hn::Shl(whole(1), lanes.log_side));
  const VF offset_step = hn::MulAdd(side, real(g.offset_per_side), real(g.offset));
  corners.step = hn::MulAdd(side, real(g.corner_per_side), real(g.corner));
  const VF scale = hn::Div(real(1.0F), corners.step);
  const VF shifted = hn::NegMulAdd(offset, offset_step, real(g.sigma));
  corners.iso = hn::MulAdd(shifted, scale, real(63.5F));
  return corners;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
