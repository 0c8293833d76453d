// Included once for each kind of processor that vector code is compiled for.
#if defined(SDF_CCD_LANE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef SDF_CCD_LANE_VECTORS_INL_H_
#undef SDF_CCD_LANE_VECTORS_INL_H_
#else
#define SDF_CCD_LANE_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include "lane_box_entry-inl.h"
#include "segment_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace sdf_ccd {
namespace HWY_NAMESPACE {
namespace {

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;
using MI = hn::Mask<I>;

constexpr F f;
constexpr I n;

inline VF real(float v) {
  return hn::Set(f, v);
}
inline VI whole(std::int32_t v) {
  return hn::Set(n, v);
}
/// Rounded towards zero; some number for NaN, which the scalar code must not cast.
HWY_INLINE VI truncated(VF v) {
#if HWY_TARGET == HWY_SCALAR
  return hn::ConvertTo(n, hn::IfThenElse(hn::IsNaN(v), hn::Zero(f), v));
#else
  return hn::ConvertTo(n, v);
#endif
}
inline MF asReal(MI m) {
  return hn::RebindMask(f, m);
}
inline MI asWhole(MF m) {
  return hn::RebindMask(n, m);
}

/// first, first + 1, ... (hn::Iota() writes the numbers one by one and stalls when it reads them.)
inline VI countFrom(int first) {
  return hn::Add(whole(first), hn::Load(n, kLaneNumbers.data()));
}
inline MI none() {
  return hn::FirstN(n, 0);
}

/// The lanes' segments: a vector of a queue's rays.
struct Lanes {
  VF o[3], d[3];
  VI cell[3];
  VF t, enter;
  VI id;
  VI index, log_side;

  Lanes(const RayQueue& queue, int first, MI used) {
    for (int k = 0; k < 3; ++k) {
      o[k] = hn::LoadU(f, queue.o[k].data() + first);
      d[k] = hn::LoadU(f, queue.d[k].data() + first);
      cell[k] = hn::LoadU(n, queue.cell[k].data() + first);
    }
    t = hn::LoadU(f, queue.t.data() + first);
    enter = real(-1.0F);
    id = hn::LoadU(n, queue.id.data() + first);
    index = hn::LoadU(n, queue.index.data() + first);
    log_side = hn::IfThenElseZero(used, hn::LoadU(n, queue.log_side.data() + first));
  }

  /// Segments that enter the grid, from index `first` of the entry on.
  Lanes(const BoxEntry& entry, int first, int first_id)
      : t(real(0.0F)), enter(real(-1.0F)), id(countFrom(first_id + first)), index(hn::Zero(n)), log_side(hn::Zero(n)) {
    for (int k = 0; k < 3; ++k) {
      o[k] = hn::LoadU(f, entry.o[k] + first);
      d[k] = hn::LoadU(f, entry.d[k] + first);
      cell[k] = hn::Zero(n);
    }
  }

  VF at(int k) const { return hn::MulAdd(d[k], t, o[k]); }
};

/// Moves the lanes of a mask to the front. The permutation is computed once for all vectors that are moved alike;
/// Highway's Compress() computes it each time, from a table that GCC copies.
class Front {
 public:
  explicit Front(MI which) : which_(which), indices_(indices(which)) {}

  VI operator()(VI v) const {
    if constexpr (kNative) return hn::Compress(v, which_);
    return hn::TableLookupLanes(v, indices_);
  }
  VF operator()(VF v) const { return hn::BitCast(f, (*this)(hn::BitCast(n, v))); }

 private:
  static constexpr bool kNative = hn::MaxLanes(n) > 8;
  using Indices = decltype(hn::IndicesFromVec(n, hn::Zero(n)));

  static Indices indices(MI which) {
    if constexpr (kNative) return hn::IndicesFromVec(n, hn::Zero(n));
    alignas(8) std::uint8_t bits[8] = {};
    hn::StoreMaskBits(n, which, bits);
    const hn::Rebind<std::uint8_t, I> bytes;
    return hn::IndicesFromVec(n, hn::PromoteTo(n, hn::LoadU(bytes, kFrontLanes[bits[0]].data())));
  }

  MI which_;
  Indices indices_;
};

/// Appends the lanes of a mask to a queue.
template <bool keeps_enter>
HWY_INLINE void append(MI which, const Lanes& lanes, VI index, VI log_side, RayQueue& queue) {
  const int end = queue.size;
  const Front front(which);
  // Stores whole vectors; the next call overwrites the lanes beyond the new end.
  const auto put = [&](VF v, RayQueue::Column<float>& column) { hn::StoreU(front(v), f, column.data() + end); };
  const auto putWhole = [&](VI v, RayQueue::Column<std::int32_t>& column) {
    hn::StoreU(front(v), n, column.data() + end);
  };
  for (int k = 0; k < 3; ++k) {
    put(lanes.o[k], queue.o[k]);
    put(lanes.d[k], queue.d[k]);
    putWhole(lanes.cell[k], queue.cell[k]);
  }
  put(lanes.t, queue.t);
  if constexpr (keeps_enter) put(lanes.enter, queue.enter);
  putWhole(lanes.id, queue.id);
  putWhole(index, queue.index);
  putWhole(log_side, queue.log_side);
  queue.size = end + static_cast<int>(hn::CountTrue(n, which));
}

/// The same for hits.
HWY_INLINE void append(MI which, VI id, VF enter, VF exit, RayHits& hits) {
  hits.makeRoom();
  const Front front(which);
  hn::StoreU(front(id), n, hits.id.data() + hits.size);
  hn::StoreU(front(enter), f, hits.enter.data() + hits.size);
  hn::StoreU(front(exit), f, hits.exit.data() + hits.size);
  hits.size += static_cast<int>(hn::CountTrue(n, which));
}

/// The block that each lane is in.
struct Blocks {
  HWY_INLINE Blocks() {}  // the implicit constructor is not compiled for this target: on Arm it cannot be called

  VI log_side;
  VI index;  ///< index of a leaf or node
  MI far;
  MI node;  ///< a node, to be descended further; a block that is neither far nor a node is a leaf
  // Where `far`: an empty sphere.
  VF ball[3];  ///< its centre, from the block's first corner [units]
  VF radius;   ///< [units]
  MI inside;
};

/// The empty spheres that the words of far top cells encode (see EmptySphere).
inline void setEmptySphere(const LaneBox& g, VI word, Blocks& b) {
  const auto offset = [&](VI high) {
    const VF cells = hn::ConvertTo(f, hn::ShiftRight<27>(high));
    return hn::MulAdd(cells, real(LaneBox::kUnits), real(g.ball_offset));
  };
  b.ball[0] = offset(hn::ShiftLeft<25>(word));
  b.ball[1] = offset(hn::ShiftLeft<20>(word));
  b.ball[2] = offset(hn::ShiftLeft<15>(word));
  const VI steps = hn::And(hn::ShiftRight<17>(word), whole(EmptySphere::kMaxSteps));
  b.radius = hn::Mul(hn::ConvertTo(f, steps), real(g.ball_step));
  b.inside = hn::Lt(word, hn::Zero(n));
}

/// The unit cubes of lanes at any t within the grid.
HWY_INLINE void findCells(const LaneBox& g, Lanes& lanes) {
  for (int k = 0; k < 3; ++k) {
    const VI last = whole(g.top_size[k] * LaneBox::kUnits - 1);
    lanes.cell[k] = hn::Min(hn::Max(truncated(lanes.at(k)), hn::Zero(n)), last);
  }
}

/// The words of top cells; the result may overwrite the indices.
inline void fetchTop(const LaneBox& g, const std::int32_t* index, int count, std::int32_t* word) {
  const std::uint32_t* top = g.top;
  for (int i = 0; i < count; ++i) word[i] = static_cast<std::int32_t>(top[index[i]]);
}

/// The index of each lane's top cell.
inline VI topIndex(const LaneBox& g, const VI* cell) {
  const VI x = hn::ShiftRight<LaneBox::kLogUnits>(cell[0]), y = hn::ShiftRight<LaneBox::kLogUnits>(cell[1]),
           z = hn::ShiftRight<LaneBox::kLogUnits>(cell[2]);
  const VI row = hn::Add(hn::Mul(z, whole(g.top_size[1])), y);
  return hn::Add(hn::Mul(row, whole(g.top_size[0])), x);
}

/// Where each lane leaves a block, and through which face.
struct Exits {
  HWY_INLINE Exits() {}  // as Blocks()

  VI low[3], side;
  VF t;
  MF axis[3];
};

HWY_INLINE Exits exitsOf(const Lanes& lanes, VI log_side) {
  Exits e;
  e.side = hn::Shl(whole(1), log_side);
  const VI mask = hn::Neg(e.side);
  VF t[3];
  for (int k = 0; k < 3; ++k) {
    e.low[k] = hn::And(lanes.cell[k], mask);
    const MF forward = hn::Gt(lanes.d[k], real(0.0F));
    const VI plane = hn::Add(e.low[k], hn::IfThenElseZero(asWhole(forward), e.side));
    const VF to_plane = hn::Sub(hn::ConvertTo(f, plane), lanes.o[k]);
    t[k] = hn::IfThenElse(hn::Eq(lanes.d[k], real(0.0F)), real(1e30F), hn::Div(to_plane, lanes.d[k]));
  }
  const VF nearest = hn::Min(t[0], hn::Min(t[1], t[2]));
  e.axis[0] = hn::Eq(t[0], nearest);
  e.axis[1] = hn::AndNot(e.axis[0], hn::Eq(t[1], nearest));
  e.axis[2] = hn::AndNot(hn::Or(e.axis[0], e.axis[1]), hn::Eq(t[2], nearest));
  e.t = hn::Max(nearest, lanes.t);
  return e;
}

/// Advances lanes to t: through the exit's face, or (`jump`) to any cell. @return lanes that have left the grid.
HWY_INLINE MI advance(const LaneBox& g, const Exits& e, MF jump, VF t, MI moving, Lanes& lanes) {
  MI outside = none();
  VI next[3];
  for (int k = 0; k < 3; ++k) {
    const VI high = hn::Add(e.low[k], e.side);
    const VI last = whole(g.top_size[k] * LaneBox::kUnits - 1);
    // Rounded towards zero; negative values are clamped.
    const VI at = truncated(hn::MulAdd(lanes.d[k], t, lanes.o[k]));
    const VI within = hn::Min(hn::Max(at, e.low[k]), hn::Sub(high, whole(1)));
    const MF forward = hn::Gt(lanes.d[k], real(0.0F));
    const VI beyond = hn::IfThenElse(asWhole(forward), high, hn::Sub(e.low[k], whole(1)));
    const VI stepped = hn::IfThenElse(asWhole(e.axis[k]), beyond, within);
    const VI jumped = hn::Min(hn::Max(at, whole(0)), last);
    const VI cell = hn::IfThenElse(asWhole(jump), jumped, stepped);
    outside = hn::Or(outside, hn::Or(hn::Lt(cell, whole(0)), hn::Gt(cell, last)));
    next[k] = cell;
  }
  for (int k = 0; k < 3; ++k) lanes.cell[k] = hn::IfThenElse(moving, next[k], lanes.cell[k]);
  lanes.t = hn::IfThenElse(asReal(moving), t, lanes.t);
  return hn::And(moving, outside);
}

/// A vector's lanes, one by one.
template <class T>
struct Unpacked {
  HWY_ALIGN T value[hn::MaxLanes(f)];
  explicit Unpacked(VF v) { hn::Store(v, f, value); }
  explicit Unpacked(VI v) { hn::Store(v, n, value); }
  T operator[](std::size_t i) const { return value[i]; }
};

template <class Mask, class Visit>
inline void forEach(const Mask& mask, const Visit& visit) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(n, mask, bytes);
  for (std::uint32_t bits = bytes[0] | std::uint32_t(bytes[1]) << 8; bits != 0; bits &= bits - 1) {
    visit(static_cast<std::size_t>(__builtin_ctz(bits)));
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace sdf_ccd
HWY_AFTER_NAMESPACE();

#endif
